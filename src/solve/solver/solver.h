#pragma once
// Interface of all running solvers.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "solve/solver/solver_state.h"

namespace lumel {

class StateReader;
class StateWriter;

/// A method that solves one world. All methods fill the same result.
class Solver {
public:
    virtual ~Solver() = default;

    /// One pass of the paper's outer loop: records and submits it.
    virtual void step() = 0;
    virtual SolverState state() const = 0;
    /// Frees GPU memory that only steps use; a further step takes it again.
    virtual void release() {}
    /// Current H [N] [lx]. Waits for the device.
    virtual std::vector<glm::vec3> irradiance() = 0;
    /// Instances whose visible noise is above the target, noisiest first; empty for methods that do
    /// not estimate it.
    virtual std::vector<NoisySurface> noisy_surfaces() const { return {}; }
    /// [N] Estimated error of each lumel relative to its light, 0…1; empty for methods that do not
    /// estimate it.
    virtual std::vector<float> error_estimate() const { return {}; }
    /// Total GPU time per stage [ms].
    virtual const gpu::StageTimes& times() const = 0;
    /// Longest submission [ms].
    virtual double longest_submission() const = 0;
    /// Ray tracing backend: "host", "query" or "raster"; empty if none.
    virtual std::string rays() const { return {}; }
    /// Complete state, with which an equal solver continues identically. Only for methods with
    /// MethodInfo::can_resume, between steps.
    virtual void write_state(StateWriter&) {}
    /// Throws Error{input} if the state is from a different solver.
    virtual void read_state(StateReader&) {}
};

}  // namespace lumel
