#pragma once
// Prepares a scene for a solver, and runs solvers, as stages that a user sees.

#include <optional>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "methods/glossy/lobe_particles.h"
#include "solve/solver/solver_state.h"

namespace lumel {

class Checkpoint;
class Ranks;
class Solver;

/// Passes on the warnings of the scene's reader.
void tell_warnings(const Scene& scene);

/// Passes on the warnings of the scene's reader and of the atlas.
void tell_user(const SolveScene& prepared);

/// Notes the size of the world in lumels.
void note_sizes(const SolveScene& world, Stages& stages);

/// Particles for the light of lobes, for a solver that supports gloss; empty for
/// Scheme::paper, whose shooters send it. The world must outlive them.
std::optional<LobeParticles> particles_for(const SolveScene& prepared,
                                           const SolverOptions& options);

/// True if the scene must be on the device to be solved: not for methods on the CPU.
bool needs_world(const BakeOptions& options);

/// A scene on a device with all inputs of a solver. Must not move.
struct Setting {
    /// device: null for methods on the CPU, if there is none. ranks: that share the work, or null.
    /// Throws Error.
    Setting(Scene scene, const gpu::Device* device, const BakeOptions& options, Stages& stages,
            Ranks* ranks = nullptr);
    /// Uses the atlas that `lay_out` makes of the scene.
    Setting(Scene scene, const SolveScene::LayOut& lay_out, const gpu::Device* device,
            const BakeOptions& options, Stages& stages, Ranks* ranks = nullptr);
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    SolveScene prepared;
    NearField near;
    std::optional<World> world;              ///< see needs_world
    std::optional<LobeParticles> particles;  ///< see particles_for

    /// Null if there are none.
    const LobeParticles* carriers() const { return particles ? &*particles : nullptr; }
};

/// Progress of a solve.
struct SolveRun {
    bool finished = false;  ///< false: stopped by the caller
    std::vector<ConvergencePoint> curve;
};

/// The options with the remaining time, which counts from the first stage on.
SolverOptions for_what_is_left(SolverOptions options, const Stages& stages);

/// Warns if a shot or time limit ended the solve before its target error.
void tell_missed(const SolverOptions& options, const SolverState& state, Stages& stages);

/// Warns if the time limit was over before the first light of all lumels. before_solving,
/// first_light: since the first stage began [s].
void tell_late(const SolverOptions& options, double before_solving, double first_light,
               Stages& stages);

/// Runs a solver up to its limits, as the stage "solving". checkpoint: read and written; or null.
/// ranks: that take the same steps, until one of them is stopped or the first one's time is over;
/// or null.
SolveRun solve_in_stage(Solver& solver, const SolverOptions& options, Stages& stages,
                        Checkpoint* checkpoint = nullptr, Ranks* ranks = nullptr);

}  // namespace lumel
