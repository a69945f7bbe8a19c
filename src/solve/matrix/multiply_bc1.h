#pragma once
// A matrix in a BC1 texture times colours of patches, on the GPU.

#include <map>

#include "solve/matrix/compressed_bc1.h"
#include "solve/matrix/multiply_bc1.comp.h"
#include "solve/matrix/vectors.h"

namespace lumel {

class MultiplyBc1 {
public:
    /// For at most `states` vectors at once. Throws Error{device}, also if the device has no BC1
    /// textures.
    MultiplyBc1(const gpu::Device& device, const Bc1Matrix& matrix, std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    const gpu::Device* device_;
    std::uint32_t width_;
    Bc1Params decoding_;
    gpu::Array<float> in_, out_;  ///< planes [states][3][width]
    Gather gather_;
    gpu::Target codes_;
    gpu::Sampler sampler_;
    std::map<std::uint32_t, gpu::Kernel<shaders::MultiplyBc1>> products_;  ///< by states at once
    Scatter scatter_;
};

}  // namespace lumel
