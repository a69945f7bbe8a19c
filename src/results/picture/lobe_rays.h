#pragma once
// Light along the lobes of glossy points: selects y by the reflection of x instead of the power of
// y. Shooters (methods/glossy/eye_image.h) suit wide lobes and lamps, rays suit narrow lobes.

#include <functional>
#include <span>
#include <vector>

#include "methods/glossy/eye_image.h"
#include "results/picture/lit_scene.h"
#include "solve/shooting/power_draw.h"

namespace lumel {

struct LobeRayOptions {
    std::uint32_t rays = 16;  ///< n_B, per point
    float shooters = 0.0f;    ///< n_A that a point received from on the device; 0: rays alone
    std::uint32_t seed = 1;
    std::uint32_t first = 0;  ///< number of the first point, whose random numbers depend on it
};

/// [P][lit.layers()] cd/m² toward the eye, weighted against the shooters by the balance heuristic
/// [VG95]. senders: with the brightness of the shooters' weights. `progress` receives the fraction
/// done and returns false to stop; all points then have equally many rays, at least one.
std::vector<glm::vec3> gather_along_lobes(std::span<const EyePoint> points, const LitScene& lit,
                                          const PowerDraw& senders, const LobeRayOptions& options,
                                          const std::function<bool(double)>& progress = {});

}  // namespace lumel
