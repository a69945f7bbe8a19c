#pragma once
// What would help a scene most, in a few sentences.

#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Up to three sentences of advice, each with what helps: on an object with most of the lumels,
/// unless densities are chosen; on back sides; and on a sky that is far too dark beside the sun.
std::vector<std::string> advice(const SolveScene& prepared, const AtlasOptions& chosen);

/// A sentence on where noise is still seen, at most three names; empty if nothing has one.
std::string where_it_is_noisy(const Scene& scene, const std::vector<NoisySurface>& surfaces);

/// What a user is told after a solve: advice(), and where noise is above the target.
std::vector<std::string> advice(const SolveScene& prepared, const BakeOptions& options,
                                const Solver& solver);

}  // namespace lumel
