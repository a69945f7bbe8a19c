#pragma once
// Our default method beside the papers': links, for glossy materials glossy, at its default
// quality.

#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "bench/papers/report.h"
#include "methods/options.h"

namespace lumel::bench {

/// A solution of a whole scene, and its cost.
struct Solved {
    std::vector<glm::vec3> irradiance;  ///< H [N] [lx]
    double cpu = 0.0, wall = 0.0;       ///< near field and upload included [s]
};

/// Solves until the targets and limits of `options`.
Solved solve_by(const gpu::Device& device, const SolveScene& world, const SolverOptions& options);

/// links, for scenes read with MaterialModel::glossy glossy, with the limits of a bake that is
/// asked for none.
Solved solve_by_default(const gpu::Device& device, const SolveScene& world);

Image map_of(const SolveScene& world, const Solved& solved);

/// "1.54 %, 0.8 s": relative RMSE and processor time. Its number is the error [%].
Cell words_of(double relative_rmse, double cpu);

}  // namespace lumel::bench
