#pragma once
// Reference solution on the CPU: a path tracer with next-event estimation from every lumel. Shares
// no transport code with the solvers.

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

/// H [N] [lx] of every lumel. Unbiased: uses the materials' emission and reflectance at each point,
/// not the lumel's mean. In a scene read with MaterialModel::glossy, light is reflected diffusely
/// and glossily (brdf.h). Runs with different seeds are independent, so two of them give the noise.
/// Light comes from emissive surfaces, punctual lights and the sky; buried lumels get 0. With one
/// seed, direct and indirect light sum to all light up to rounding. `progress` receives the
/// fraction done and returns false to stop; the result then has the samples taken so far, and is
/// empty if some lumels have none.
std::vector<glm::vec3> reference_irradiance(const Scene& scene, const RayScene& rays,
                                            const Lumels& lumels, const ReferenceOptions& options,
                                            const std::function<bool(double)>& progress = {});

}  // namespace lumel
