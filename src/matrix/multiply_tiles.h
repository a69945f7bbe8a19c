#pragma once
// A matrix of tiles in local bases times colours of patches, on the GPU.

#include "matrix/compressed_tiles.h"
#include "matrix/vectors.h"

namespace lumel {

class MultiplyTiles {
public:
    /// For at most `states` vectors at once. Throws Error{device}.
    MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix, std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    std::uint32_t clusters_;
    float unit_;
    gpu::Array<float> in_, seen_, sent_, out_;  ///< planes: of patches, of coefficients
    Gather gather_;
    gpu::Array<std::uint32_t> first_basis_;  ///< [clusters + 1] rows of all bases before
    gpu::Array<std::uint32_t> basis_;        ///< two half floats a word
    gpu::Array<std::uint32_t> first_;        ///< [fine, coarse][axis][tile rows + 1]
    gpu::Array<std::uint32_t> fine_place_, fine_, coarse_place_, coarse_;
    Scatter scatter_;
    gpu::Kernel project_, product_, expand_;
};

}  // namespace lumel
