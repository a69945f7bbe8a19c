#include "solve/solve_size.h"

#include "solve/directions.h"
#include "solve/gather.h"
#include "solve/glossy.h"
#include "solve/matrix.h"
#include "solve/progressive.h"
#include "solve/stochastic.h"

namespace lumel {

std::uint64_t solver_bytes(const SolveSize& size, const SolverOptions& options)
{
    if (options.method == "directions")
        return GlobalDirections::device_bytes(size, options);
    if (options.method == "gather")
        return GatherRadiosity::device_bytes(size, options);
    if (options.method == "progressive")
        return ProgressiveRadiosity::device_bytes(size, options);
    if (options.method == "matrix")
        return MatrixRadiosity::device_bytes(size, options);
    if (method_of(options.method).materials == MaterialModel::glossy)
        return GlossyIllumination::device_bytes(size, options);
    return StochasticRadiosity::device_bytes(size, options);
}

}  // namespace lumel
