#pragma once
// Direct light of everything that is no lumel: sky, sun and lamps.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "gpu/pacer.h"
#include "raster/world/world.h"
#include "scene/values/scene.h"

namespace lumel {

struct DirectLightOptions {
    std::uint32_t sky_directions = 1024;  ///< sampled of the sky, 0: without it
    std::uint32_t sun_directions = 256;   ///< for each directional light
    std::uint32_t disc_directions = 256;  ///< for each that has a disc
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

struct DirectLight {
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]
    gpu::StageTimes times;              ///< on the device [ms]
    bool finished = true;               ///< false: stopped by the caller, light is missing
};

/// True if the scene has a source that is no surface.
bool has_lights(const Scene& scene);

/// Bytes on the device that direct_light() holds beside the world, on one without a limit to
/// the size of images. diagonal: of the scene's bounding box [m].
std::uint64_t direct_light_bytes(const Scene& scene, const Lumels& lumels, float diagonal);

/// Finds the direct light of the scene's sky and lights some views at a time. How they are cut does
/// not change the result.
class DirectLightSearch {
public:
    /// All but the options must outlive it, and the world stay as it is.
    DirectLightSearch(const gpu::Device& device, const World& world, const Scene& scene,
                      const Lumels& lumels, const DirectLightOptions& options);
    ~DirectLightSearch();

    /// Draws views of about `pixels` in all, one at least. It must not be done.
    void step(std::uint64_t pixels);
    /// Until the device has done what step() gave it.
    void wait();
    bool is_done() const;
    /// Part of the whole.
    double done() const;
    /// Stops where it is not done. Waits for the device.
    DirectLight take();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Direct light of the scene's sky and lights. `go_on` receives the fraction done and returns false
/// to stop; what has been found by then is returned.
DirectLight direct_light(const gpu::Device& device, const World& world, const Scene& scene,
                         const Lumels& lumels, const DirectLightOptions& options,
                         const std::function<bool(double)>& go_on = {});

}  // namespace lumel
