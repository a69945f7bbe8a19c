#pragma once
// A scene's light: from sky and lamps straight to the lumels, and from there on by a solver.

#include <memory>
#include <optional>
#include <vector>

#include "jobs/solve/setting.h"
#include "links/kept/stored_links.h"
#include "methods/matrix/relightable.h"

namespace lumel {

/// The direct light that suits a solver: without the sky if the solver gathers that.
DirectLightOptions direct_light_options(const SolverOptions& solver, std::uint32_t sky_directions);

/// The directional light asked for, of a solution that took `solver_shots`.
DirectionalOptions directional_options(const BakeOptions& options, std::uint64_t solver_shots);

/// Sky and lamps' direct light, as the stage "sky and lamps"; empty if there are none.
DirectLight light_of_lamps(const gpu::Device& device, const Setting& setting,
                           const BakeOptions& options, Stages& stages);

/// Who brings what lobes reflect of the sky and of lamps.
enum class Lobes {
    diffuse,  ///< nobody: surfaces reflect it equally in all directions
    carried,  ///< particles
};

/// Lumels that send on, beside their own light, what they reflect of `light` [N] [lx]. None if that
/// is empty: then they stay as they are.
std::optional<Lumels> shining(const Lumels& lumels, const std::vector<glm::vec3>& light,
                              Lobes lobes = Lobes::diffuse);

/// A solver that has run, and what came of it.
struct Solution {
    DirectLight lamps;  ///< of sky and lamps
    std::optional<Lumels>
        lumels;  ///< the solver's, which it reads while it lives; none: the world's
    std::unique_ptr<Solver> solver;
    SolveRun run;
    std::vector<glm::vec3> irradiance;          ///< [N] [lx] of the requested parts
    std::optional<Relightable> relightable;     ///< where sources were kept apart to the end
    std::optional<FormFactorRow> form_factors;  ///< the same
    std::optional<StoredLinks> links;           ///< where they are kept
};

/// Solves for the parts of the light that options.parts names. The direct light of emissive
/// surfaces is what the solver finds where nothing reflects; indirect light then starts from all
/// direct light that surfaces reflect. So indirect light takes two solves, and its first bounce
/// is diffuse whatever the method. One solve would not do: its sums do not keep apart what emissive
/// surfaces send and what lamps leave on the surfaces.
/// checkpoint: of a method that can go on from one, or null.
std::unique_ptr<Solution> solve_light(const gpu::Device& device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages,
                                      Checkpoint* checkpoint = nullptr);

}  // namespace lumel
