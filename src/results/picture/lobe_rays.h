#pragma once
// Light that rays along the lobes of glossy points find: y is chosen by what x reflects instead
// of by what y sends. Shooters (methods/glossy/eye_image.h) are good at wide lobes and
// lamps, rays at narrow lobes.

#include <functional>
#include <span>
#include <vector>

#include "methods/glossy/eye_image.h"
#include "rays/paths/surfaces.h"
#include "results/picture/lit_scene.h"
#include "solve/shooting/power_draw.h"

namespace lumel {

struct LobeRayOptions {
    std::uint32_t rays = 16;  ///< n_B, for each point
    float shooters = 0.0f;    ///< n_A that a point met on the device; 0: rays do it alone
    std::uint32_t seed = 1;
};

/// [P] cd/m² toward the eye, weighted against the shooters by the balance heuristic [VG95].
/// senders: with the brightness that the shooters were weighted with. `progress` receives the
/// fraction done and returns false to stop, which leaves each point as many rays as the others, one
/// at least.
std::vector<glm::vec3> gather_along_lobes(std::span<const EyePoint> points, const RayScene& rays,
                                          const Surfaces& surfaces, const LitScene& lit,
                                          const PowerDraw& senders, const LobeRayOptions& options,
                                          const std::function<bool(double)>& progress = {});

}  // namespace lumel
