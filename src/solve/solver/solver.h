#pragma once
// What every method at work offers.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "solve/solver/solver_state.h"

namespace lumel {

class StateReader;
class StateWriter;

/// A method at work on one world. Every method fills the same result.
class Solver {
public:
    virtual ~Solver() = default;

    /// One pass of the paper's outer loop, recorded and submitted.
    virtual void step() = 0;
    virtual SolverState state() const = 0;
    /// H [N] [lx] of the solution so far. Waits for the device.
    virtual std::vector<glm::vec3> irradiance() = 0;
    /// Device time per stage [ms] so far.
    virtual const gpu::StageTimes& times() const = 0;
    /// Longest submission so far [ms].
    virtual double longest_submission() const = 0;
    /// Who casts its rays, "host", "query" or "raster"; empty if it casts none.
    virtual std::string rays() const { return {}; }
    /// All that another solver needs that was made in the same way, to go on as this one would:
    /// only of methods with MethodInfo::can_resume, between steps.
    virtual void write_state(StateWriter&) {}
    /// Throws Error{input} for what was written by a solver of something else.
    virtual void read_state(StateReader&) {}
};

}  // namespace lumel
