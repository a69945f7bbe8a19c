#pragma once
// Directions of the light of sky, sun and lamps. See light_directions.cpp.

#include <functional>
#include <vector>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "results/directional/directional_fit.h"

namespace lumel {

struct LightDirectionsOptions {
    SampleRule rule = SampleRule::area;
    std::uint32_t seed = 1;
};

/// True if there are lights other than surfaces.
bool has_far_lights(const Scene& scene);

/// Adds their light to coefficients [4 or 9][N] of radiance [cd/m²], by rays on the CPU. normals
/// [N]: unit, world space. `go_on` receives the fraction done and returns false to stop early; then
/// this returns false, and the light of some lumels is missing.
bool add_light_directions(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                          const std::vector<glm::vec3>& normals, const DirectionalFit& fit,
                          const LightDirectionsOptions& options,
                          std::vector<std::vector<glm::vec3>>& coefficients,
                          const std::function<bool(double)>& go_on = {});

}  // namespace lumel
