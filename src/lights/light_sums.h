#pragma once
// Irradiance that is gathered source by source.

#include <vector>

#include "gpu/pacer.h"
#include "lights/light_sums.shared.h"

namespace lumel {

/// Sums of the source at work, and of all before it. A kernel adds to sums().
class SummedLight {
public:
    SummedLight(const gpu::Device& device, std::size_t lumels);

    std::uint32_t lumels() const { return std::uint32_t(irradiance_.size()); }
    const gpu::Array<LightSums>& sums() const { return sums_; }

    /// Ends a source.
    void finish_source(gpu::Pacer& pacer);
    /// H [N] [lx] of all sources that have ended. The pacer must have finished.
    std::vector<glm::vec3> irradiance() const { return irradiance_.download(); }

private:
    gpu::Array<LightSums> sums_;
    gpu::Array<glm::vec3> irradiance_;
    gpu::Kernel finish_;
};

}  // namespace lumel
