#pragma once
// Direct light of sky, sun and lamps by shadow maps.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "gpu/pacer.h"
#include "raster/world/world.h"
#include "scene/values/scene.h"

namespace lumel {

struct DirectLightOptions {
    std::uint32_t sky_directions = 1024;  ///< samples of the sky, 0: no sky
    std::uint32_t sun_directions = 256;   ///< for each directional light
    std::uint32_t disc_directions = 256;  ///< for each with a disc
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

struct DirectLight {
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]
    gpu::StageTimes times;              ///< on the GPU [ms]
    bool finished = true;               ///< false: stopped by the caller, incomplete
};

/// True if the scene has sky, sun or lamps.
bool has_lights(const Scene& scene);

/// GPU memory of direct_light() beside the world [bytes], for images of any size. diagonal: of the
/// scene's bounding box [m].
std::uint64_t direct_light_bytes(const Scene& scene, const Lumels& lumels, float diagonal);

/// Computes direct light of the scene's sky and lights, some views per step. The division into
/// steps does not change the result.
class DirectLightSearch {
public:
    /// All arguments but the options must outlive this, and the world must not change.
    DirectLightSearch(const gpu::Device& device, const World& world, const Scene& scene,
                      const Lumels& lumels, const DirectLightOptions& options);
    ~DirectLightSearch();

    /// Renders views of about `pixels` pixels in total, at least one view. Requires !is_done().
    void step(std::uint64_t pixels);
    /// Waits until the GPU has finished the steps.
    void wait();
    bool is_done() const;
    /// Fraction of the work that is done.
    double done() const;
    /// Returns the result, incomplete unless done. Waits for the GPU.
    DirectLight take();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Direct light of the scene's sky and lights. `go_on` receives the fraction done and returns false
/// to stop; the result is then incomplete.
DirectLight direct_light(const gpu::Device& device, const World& world, const Scene& scene,
                         const Lumels& lumels, const DirectLightOptions& options,
                         const std::function<bool(double)>& go_on = {});

}  // namespace lumel
