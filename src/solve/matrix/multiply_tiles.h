#pragma once
// A matrix of tiles in local bases times colours of patches, on the GPU.

#include "solve/matrix/compressed_tiles.h"
#include "solve/matrix/multiply_tiles.expand.comp.h"
#include "solve/matrix/multiply_tiles.product.comp.h"
#include "solve/matrix/multiply_tiles.project.comp.h"
#include "solve/matrix/vectors.h"

namespace lumel {

class MultiplyTiles {
public:
    /// For at most `states` vectors at once. Throws Error{device}.
    MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix, std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix,
                  const std::array<std::array<TileRows, 3>, kPrecisions>& tiles,
                  std::uint32_t states);

    std::uint32_t clusters_;
    float unit_;
    gpu::Array<float> in_, seen_, sent_, out_;  ///< planes: of patches, of coefficients
    Gather gather_;
    gpu::Array<std::uint32_t> first_basis_;  ///< [clusters + 1] rows of all bases before
    gpu::Array<std::uint32_t> basis_;        ///< four codes a word
    gpu::Array<float> basis_unit_;           ///< of each row
    gpu::Array<std::uint32_t> first_;        ///< [precision][axis][tile rows + 1], of all tiles
    gpu::Array<std::uint32_t> place_;        ///< of all tiles
    gpu::Array<std::uint32_t> codes4_, codes8_, codes16_;
    Scatter scatter_;
    gpu::Kernel<shaders::MultiplyTilesProject> project_;
    gpu::Kernel<shaders::MultiplyTilesProduct> product_;
    gpu::Kernel<shaders::MultiplyTilesExpand> expand_;
};

}  // namespace lumel
