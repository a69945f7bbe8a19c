#pragma once
// A matrix of coded entries times colours of patches, on the GPU.

#include "bench/papers/matrix_rows.h"
#include "solve/matrix/vectors.h"

namespace lumel::bench {

class MultiplyCoded {
public:
    /// For at most `states` vectors at once. Throws Error{device}.
    MultiplyCoded(const gpu::Device& device, const CodedMatrix& matrix, std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    std::uint32_t width_;
    gpu::Array<float> in_, out_;  ///< planes [states][3][width]
    Gather gather_;
    RowsProduct product_;
    Scatter scatter_;
};

}  // namespace lumel::bench
