#pragma once
// Irradiance, summed source by source.

#include <vector>

#include "gpu/pacer.h"
#include "raster/shadow_maps/light_sums.finish.comp.h"
#include "raster/shadow_maps/light_sums.shared.h"

namespace lumel {

/// Maximum pixels of a batch of views (32 MiB).
inline constexpr std::uint64_t kMaxLightPixels = 8u << 20;

/// Sums of the current source and of all previous ones. Kernels add to sums().
class SummedLight {
public:
    SummedLight(const gpu::Device& device, std::size_t lumels);

    /// GPU memory [bytes].
    static std::uint64_t bytes(std::size_t lumels)
    {
        return lumels * (sizeof(LightSums) + sizeof(glm::vec3));
    }

    std::uint32_t lumels() const { return std::uint32_t(irradiance_.size()); }
    const gpu::Array<LightSums>& sums() const { return sums_; }

    /// Completes the current source.
    void finish_source(gpu::Pacer& pacer);
    /// Waits for the pacer and keeps its times.
    void finish(gpu::Pacer& pacer);
    /// GPU time per kind of work [ms], of all finished pacers.
    const gpu::StageTimes& times() const { return times_; }
    /// H [N] [lx] of all completed sources. Their pacers must have finished.
    std::vector<glm::vec3> irradiance() const { return irradiance_.download(); }

private:
    gpu::Array<LightSums> sums_;
    gpu::Array<glm::vec3> irradiance_;
    gpu::Kernel<shaders::LightSumsFinish> finish_;
    gpu::StageTimes times_;
};

}  // namespace lumel
