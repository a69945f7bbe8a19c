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
    std::uint32_t points = 16;        ///< rotated views per point light
    std::uint32_t ball_points = 128;  ///< per spherical lamp
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds the direct irradiance of the scene's point and spot lights to a sum, each lamp as one
/// source, some views per step. The division into steps does not change the result. Always uses
/// hemicubes, whose edges are exact.
class LampLight {
public:
    /// device, world and light must outlive this, and the world must not change.
    LampLight(const gpu::Device& device, const World& world, const Scene& scene,
              const LampOptions& options, SummedLight& light);
    ~LampLight();

    /// Renders hemicubes of one lamp, of about `pixels` pixels in total, at least one, and adds
    /// their light. Waits for the GPU after the last.
    void step(std::uint64_t pixels);
    void wait();
    bool is_done() const { return lamp_ == eyes_.size(); }
    /// Fraction of the work that is done.
    double done() const;
    /// Accepts the light found so far as complete. Waits for the GPU.
    void finish();

private:
    struct Stage;

    SummedLight* light_;
    std::vector<std::vector<Eye>> eyes_;  ///< [lamps] eyes
    std::size_t lamp_ = 0, next_ = 0;     ///< current lamp and its next eye
    std::unique_ptr<Stage> stage_;        ///< null without lamps
};

/// Pixels of a batch of views.
std::uint64_t lamp_pixels(const LampOptions& options);

}  // namespace lumel
