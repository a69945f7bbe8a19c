#pragma once
// Directions of the light of a finished solution. See directional.cpp.

#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/lumels/sample_rule.h"
#include "atlas/near/near_field.h"
#include "gpu/commands.h"
#include "raster/eyes/eye_views.h"
#include "raster/world/world.h"
#include "results/directional/directional_fit.h"
#include "solve/solver/solve_size.h"

namespace lumel {

/// Contents of directional lightmaps: coefficients of bands 0…order.
enum class Directional : std::uint8_t { none = 0, sh1 = 1, sh2 = 2 };

struct DirectionalOptions {
    Directional kind = Directional::sh1;
    SampleRule rule = SampleRule::area;
    std::uint32_t seed = 1;
    std::uint32_t batch = 16;  ///< shooters per batch
    Projection projection = Projection::hemicube;
    std::uint32_t hemicube = 256;  ///< side of the front face [pixels], see EyeViews
    std::uint64_t shots = 4096;
};

struct DirectionalLight {
    /// [4 or 9][N] radiance [cd/m²] × Y_lm in world space, at l² + l + m.
    std::vector<std::vector<glm::vec3>> coefficients;
    std::uint64_t shots = 0;
    gpu::StageTimes times;  ///< on the GPU [ms]
};

/// GPU memory of gather_directional() [bytes], if the device does not limit images.
std::uint64_t directional_bytes(const SolveSize& size, const DirectionalOptions& options);

/// Number of shooters for a solution that took `solver_shots`; 0: for one without shooters.
std::uint64_t directional_shots(std::uint64_t solver_shots);

/// Unit shading normals of the lumels [N], world space.
std::vector<glm::vec3> world_normals(const Scene& scene, const Lumels& lumels);

/// Gathers light from all lumels' radiosity E + ρH, for `irradiance` [N] [lx] of any method, and
/// from sky, sun and lamps. irradiance_at() of a lumel's coefficients at its own normal is its
/// irradiance. near: as in the solve, may be empty. `go_on` receives the fraction done and returns
/// false to stop early.
DirectionalLight gather_directional(const gpu::Device& device, const World& world,
                                    const Scene& scene, const RayScene& rays, const Lumels& lumels,
                                    const NearField& near, const std::vector<glm::vec3>& irradiance,
                                    const DirectionalOptions& options,
                                    const std::function<bool(double)>& go_on = {});

}  // namespace lumel
