#pragma once
// The picture that a camera would take, by path tracing on the CPU.

#include <cstdint>
#include <functional>

#include "base/core/image.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"
#include "scene/values/view.h"

namespace lumel {

struct ReferenceImageOptions {
    int width = 640;   ///< [pixels] the view's aspect is kept: pixels may be oblong
    int height = 480;  ///< [pixels]
    int samples_per_pixel = 256;
    std::uint32_t seed = 1;
    int max_bounces = 1024;  ///< Russian roulette ends paths; this guards albedo 1
};

/// Radiance [cd/m²], linear RGBA [height][width], as seen from `view`: what surfaces emit and
/// reflect, glossily if the scene was read with MaterialModel::glossy. A pixel is the mean over its
/// square; alpha is the share of it where anything is seen, the sky being something, and colours
/// are multiplied by it. Unbiased, and independent for each seed. Punctual lights shine, but are
/// not seen, and backs of single-sided emissive surfaces are black. `progress` is given the
/// fraction done and returns false to stop, which leaves the samples taken so far; an empty image
/// if some pixels have none yet.
Image reference_image(const Scene& scene, const RayScene& rays, const View& view,
                      const ReferenceImageOptions& options,
                      const std::function<bool(double)>& progress = {});

}  // namespace lumel
