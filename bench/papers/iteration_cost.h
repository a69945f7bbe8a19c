#pragma once
// What an iteration takes.

#include "gpu/device.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"

namespace lumel::bench {

struct IterationCost {
    double cpu_ms = 0.0;
    double wall_ms = 0.0;
    gpu::StageTimes stages;  ///< on the device [ms]
    gpu::Recorded recorded;  ///< of an iteration in which no error is estimated
};

/// Of the fastest of a few stretches of this number of iterations.
IterationCost cost_of_iteration(const gpu::Device& device, Solver& solver, int iterations);

/// Sum of the stages named [ms].
double sum_of(const gpu::StageTimes& stages, std::initializer_list<const char*> names);

/// What stages took between two looks at them [ms].
gpu::StageTimes since(const gpu::StageTimes& earlier, gpu::StageTimes now);

/// The papers' iteration: one shooter, drawn independently of all others.
SolverOptions papers_iteration(MethodOptions method);

/// Without pairs: the papers have no near field.
NearField no_near_field(const Lumels& lumels);

}  // namespace lumel::bench
