#pragma once
// Lights a scene: direct light of sky and lamps, then a solver.

#include <memory>
#include <optional>
#include <vector>

#include "jobs/solve/setting.h"
#include "methods/matrix/relightable.h"

namespace lumel {

/// Direct light options for a solver: without the sky if the solver gathers it.
DirectLightOptions direct_light_options(const SolverOptions& solver, std::uint32_t sky_directions);

/// Directional options for a solution that took `solver_shots`.
DirectionalOptions directional_options(const BakeOptions& options, std::uint64_t solver_shots);

/// Direct light of sky and lamps, as the stage "sky and lamps"; empty if there are none, or the
/// method finds it.
DirectLight light_of_lamps(const gpu::Device* device, const Setting& setting,
                           const BakeOptions& options, Stages& stages);

/// Treatment of sky and lamp light on lobes.
enum class Lobes {
    diffuse,  ///< reflected equally in all directions
    carried,  ///< carried by particles
};

/// Lumels that emit their reflection of `light` [N] [lx] in addition to their own emission; empty
/// if `light` is.
std::optional<Lumels> shining(const Lumels& lumels, const std::vector<glm::vec3>& light,
                              Lobes lobes = Lobes::diffuse);

/// A finished solver with its results.
struct Solution {
    DirectLight lamps;             ///< by sky and lamps
    std::optional<Lumels> lumels;  ///< the solver's, in use by it; empty: the world's
    std::unique_ptr<Solver> solver;
    SolveRun run;
    std::vector<glm::vec3> irradiance;          ///< [N] [lx] of the requested parts
    std::optional<Relightable> relightable;     ///< if sources were kept separate to the end
    std::optional<FormFactorRow> form_factors;  ///< if sources were kept separate
};

/// Solves for options.parts of the light. Direct light of emissive surfaces is the solution without
/// reflection; indirect light then starts from all direct light that surfaces reflect. Indirect
/// light therefore takes two solves, and its first bounce is diffuse for any method. One solve is
/// not enough: its sums mix the light of emissive surfaces with that of lamps on surfaces.
/// device: null for methods on the CPU, if there is none. checkpoint: of a method that can
/// continue, or null. ranks: that share the work of links, or null.
std::unique_ptr<Solution> solve_light(const gpu::Device* device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages,
                                      Checkpoint* checkpoint = nullptr, Ranks* ranks = nullptr);

}  // namespace lumel
