#pragma once
// A scene's light: from sky and lamps straight to the lumels, and from there on by a solver.

#include <memory>
#include <vector>

#include "bake/setting.h"

namespace lumel {

/// Sky and lamps' direct light [N] [lx], as the stage "sky and lamps"; 0 if there are none. Without
/// the sky for a solver that gathers it.
std::vector<glm::vec3> light_of_lamps(const gpu::Device& device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages);

/// Lumels that send on, beside their own light, what they reflect of `light` [N] [lx].
Lumels shining(const Lumels& lumels, const std::vector<glm::vec3>& light);

/// Adds `more` [N] [lx] to `sum`.
void add_light(std::vector<glm::vec3>& sum, const std::vector<glm::vec3>& more);

/// A solver that has run, and what came of it.
struct Solution {
    Lumels lumels;  ///< the solver's: it reads them while it lives
    std::unique_ptr<Solver> solver;
    SolveRun run;
    std::vector<glm::vec3> irradiance;  ///< [N] [lx] of the parts asked for
};

/// Solves for the parts of the light that options.parts asks for. Emissive surfaces' direct light
/// is what the solver finds where nothing reflects; what all direct light leaves on the surfaces is
/// then what indirect light starts from.
std::unique_ptr<Solution> solve_light(const gpu::Device& device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages);

}  // namespace lumel
