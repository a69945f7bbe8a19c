#pragma once
// Point and spot lights, through hemicubes.

#include <cstdint>
#include <memory>
#include <vector>

#include "raster/eyes/eye_views.h"
#include "raster/shadow_maps/light_sums.h"
#include "scene/values/scene.h"

namespace lumel {

struct LampOptions {
    std::uint32_t hemicube = 512;     ///< side of the front face [pixels], see EyeViews
    std::uint32_t points = 16;        ///< looked from per lamp that is a point
    std::uint32_t ball_points = 128;  ///< per lamp that is a ball
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds the direct light of the scene's point and spot lights at the lumels to a sum, each lamp as
/// one source, a few of their views at a time. How they are cut does not change the result.
/// Hemicubes, whose edges are exact, are used whatever projection solvers use.
class LampLight {
public:
    /// device, world and light must outlive it, and the world stay as it is.
    LampLight(const gpu::Device& device, const World& world, const Scene& scene,
              const LampOptions& options, SummedLight& light);
    ~LampLight();

    /// Draws hemicubes of about `pixels` in all, of one lamp, one at least, and adds their light.
    /// Waits for the device after the last.
    void step(std::uint64_t pixels);
    void wait();
    bool is_done() const { return lamp_ == eyes_.size(); }
    /// Part of the whole.
    double done() const;
    /// Counts what has been found as the whole. Waits for the device.
    void finish();

private:
    struct Stage;

    SummedLight* light_;
    std::vector<std::vector<Eye>> eyes_;  ///< of each lamp
    std::size_t lamp_ = 0, next_ = 0;     ///< eye of it
    std::unique_ptr<Stage> stage_;        ///< none where there are no lamps
};

/// Pixels of the views of one batch.
std::uint64_t lamp_pixels(const LampOptions& options);

}  // namespace lumel
