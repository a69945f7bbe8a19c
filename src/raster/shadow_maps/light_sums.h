#pragma once
// Irradiance that is gathered source by source.

#include <vector>

#include "gpu/pacer.h"
#include "raster/shadow_maps/light_sums.finish.comp.h"
#include "raster/shadow_maps/light_sums.shared.h"

namespace lumel {

/// Pixels of all views of a source in one batch: bounds them to 32 MiB.
inline constexpr std::uint64_t kMaxLightPixels = 8u << 20;

/// Sums of the source at work, and of all before it. A kernel adds to sums().
class SummedLight {
public:
    SummedLight(const gpu::Device& device, std::size_t lumels);

    /// Bytes on the device.
    static std::uint64_t bytes(std::size_t lumels)
    {
        return lumels * (sizeof(LightSums) + sizeof(glm::vec3));
    }

    std::uint32_t lumels() const { return std::uint32_t(irradiance_.size()); }
    const gpu::Array<LightSums>& sums() const { return sums_; }

    /// Ends a source.
    void finish_source(gpu::Pacer& pacer);
    /// Finishes, and keeps the times.
    void finish(gpu::Pacer& pacer);
    /// Device time per kind of work [ms], of all pacers that have finished.
    const gpu::StageTimes& times() const { return times_; }
    /// H [N] [lx] of all sources that have ended. Their pacers must have finished.
    std::vector<glm::vec3> irradiance() const { return irradiance_.download(); }

private:
    gpu::Array<LightSums> sums_;
    gpu::Array<glm::vec3> irradiance_;
    gpu::Kernel<shaders::LightSumsFinish> finish_;
    gpu::StageTimes times_;
};

}  // namespace lumel
