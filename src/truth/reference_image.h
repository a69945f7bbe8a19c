#pragma once
// Path-traced image of a camera, on the CPU.

#include <cstdint>
#include <functional>

#include "base/core/image.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"
#include "scene/values/view.h"

namespace lumel {

struct ReferenceImageOptions {
    int width = 640;   ///< [pixels] the view's aspect is kept: pixels can be oblong
    int height = 480;  ///< [pixels]
    int samples_per_pixel = 256;
    std::uint32_t seed = 1;
    int max_bounces = 1024;  ///< Russian roulette ends paths; this guards albedo 1
};

/// Radiance [cd/m²], linear RGBA [height][width], from `view`: emitted and reflected light,
/// glossily if the scene was read with MaterialModel::glossy. A pixel is the mean over its square;
/// alpha is the covered fraction, sky included, and colours are multiplied by it. Unbiased, and
/// independent for each seed. Punctual lights are invisible, and backs of single-sided emissive
/// surfaces are black. `progress` receives the fraction done and returns false to stop; the result
/// then has the samples taken so far, and is empty if some pixels have none.
Image reference_image(const Scene& scene, const RayScene& rays, const View& view,
                      const ReferenceImageOptions& options,
                      const std::function<bool(double)>& progress = {});

}  // namespace lumel
