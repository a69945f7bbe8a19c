#pragma once
// Ground truth on the CPU: a path tracer with next-event estimation from every lumel.
// Shares no transfer code with the solvers.

#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/parts.h"
#include "scene/values/scene.h"

namespace lumel {

struct ReferenceOptions {
    int samples_per_lumel = 256;
    std::uint32_t seed = 1;
    SampleRule rule = SampleRule::area;
    int max_bounces = 1024;  ///< Russian roulette ends paths; this guards albedo 1
    Parts parts = Parts::all;
};

/// H [N] [lx] of every lumel. Unbiased: emission and reflectance are those of the surfaces'
/// materials at each point, not the lumel's mean. Of a scene read with MaterialModel::glossy light
/// is passed on by diffuse and by glossy reflection (brdf.h). Runs that differ in seed are
/// independent, so two of them give the noise. Light comes from emissive surfaces, punctual lights
/// and the sky; buried lumels get 0. With one seed, direct and indirect light add up to all but for
/// rounding. `progress` receives the fraction done and returns false to stop, which leaves the
/// samples taken so far; nothing if some lumels have none yet.
std::vector<glm::vec3> reference_irradiance(const Scene& scene, const RayScene& rays,
                                            const Lumels& lumels, const ReferenceOptions& options,
                                            const std::function<bool(double)>& progress = {});

}  // namespace lumel
