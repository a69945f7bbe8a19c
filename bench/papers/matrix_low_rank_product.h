#pragma once
// A matrix of low rank times colours of patches, on the GPU: three thin products.

#include "bench/papers/matrix_low_rank.h"
#include "bench/papers/matrix_rows.h"
#include "solve/matrix/vectors.h"

namespace lumel::bench {

class MultiplyLowRank {
public:
    /// For at most `states` vectors at once. Throws Error{device}.
    MultiplyLowRank(const gpu::Device& device, const LowRankMatrix& matrix, std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    std::uint32_t width_, rank_width_;
    gpu::Array<float> in_, seen_, sent_, out_;  ///< planes: of patches, of patterns
    Gather gather_;
    RowsProduct see_, core_, send_;  ///< U^T, S, U
    Scatter scatter_;
};

}  // namespace lumel::bench
