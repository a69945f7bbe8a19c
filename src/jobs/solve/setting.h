#pragma once
// A scene made ready for a solver, and a solver let run, as the stages that a user sees.

#include <optional>
#include <vector>

#include "atlas/prepare/prepare.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "methods/glossy/lobe_particles.h"
#include "solve/solver/solver_state.h"

namespace lumel {

class Checkpoint;
class Solver;

/// Says what the scene's reader had to say.
void tell_warnings(const Scene& scene);

/// Says what the scene's reader and the atlas had to say.
void tell_user(const Prepared& prepared);

/// Notes how large the world is, as lumels count.
void note_sizes(const Prepared& world, Stages& stages);

/// Who carries what lobes send on, for a solver that knows gloss; none for Scheme::paper, whose
/// shooters send it. The world must outlive them.
std::optional<LobeParticles> particles_for(const Prepared& prepared, const SolverOptions& options);

/// Must the scene be on the device before it is solved? Not for methods on the host.
bool needs_world(const BakeOptions& options);

/// A scene on a device with all that a solver is made of. Stays where it was made.
struct Setting {
    /// Throws Error.
    Setting(Scene scene, const gpu::Device& device, const BakeOptions& options, Stages& stages);
    /// The same with an atlas that `lay_out` makes of the scene.
    Setting(Scene scene, const Prepared::LayOut& lay_out, const gpu::Device& device,
            const BakeOptions& options, Stages& stages);
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    Prepared prepared;
    NearField near;
    std::optional<World> world;              ///< see needs_world
    std::optional<LobeParticles> particles;  ///< see particles_for

    /// The same for a solver, null if there are none.
    const LobeParticles* carriers() const { return particles ? &*particles : nullptr; }
};

/// How a solve went.
struct SolveRun {
    bool finished = false;  ///< false: stopped by the caller
    std::vector<ConvergencePoint> curve;
};

/// The options with what is left of their time, which counts from the first stage on.
SolverOptions for_what_is_left(SolverOptions options, const Stages& stages);

/// Warns if a solve that ended by a limit of shots or time did not reach an error that was asked
/// for.
void tell_missed(const SolverOptions& options, const SolverState& state, Stages& stages);

/// Runs a solver up to the limits in its options, as the stage "solving". checkpoint: that it goes
/// on from, and keeps; or null.
SolveRun solve_in_stage(Solver& solver, const SolverOptions& options, Stages& stages,
                        Checkpoint* checkpoint = nullptr);

}  // namespace lumel
