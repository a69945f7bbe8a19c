#include "bench/papers/iteration_cost.h"

#include <algorithm>

#include "bench/stopwatch.h"

namespace lumel::bench {
namespace {

constexpr int kStretches = 3;
constexpr int kWarmUp = 8;  ///< iterations

/// [BJ04] and [BSS05]: from and to the centres of texels.
template <class Options>
constexpr bool shoots_from_texels =
    std::is_same_v<Options, StochasticOptions> || std::is_same_v<Options, GlossyOptions>;

IterationCost measure(const gpu::Device& device, Solver& solver, int iterations)
{
    IterationCost cost;
    const gpu::StageTimes before = solver.times();
    std::vector<gpu::Recorded> steps;
    Stopwatch watch;
    watch.start();
    for (int i = 0; i < iterations; ++i) {
        const gpu::Recorded start = device.recorded();
        solver.step();
        const gpu::Recorded& end = device.recorded();
        steps.push_back({end.dispatches - start.dispatches, end.passes - start.passes,
                         end.draws - start.draws});
    }
    solver.irradiance();  // waits
    watch.stop();
    cost.cpu_ms = 1e3 * watch.cpu / iterations;
    cost.wall_ms = 1e3 * watch.wall / iterations;
    cost.stages = since(before, solver.times());
    for (auto& [stage, ms] : cost.stages)
        ms /= iterations;
    // Now and then the error is estimated too, which the median leaves out.
    const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end(),
                     [](const auto& a, const auto& b) { return a.dispatches < b.dispatches; });
    cost.recorded = *middle;
    return cost;
}

}  // namespace

IterationCost cost_of_iteration(const gpu::Device& device, Solver& solver, int iterations)
{
    measure(device, solver, kWarmUp);
    IterationCost best = measure(device, solver, iterations);
    for (int i = 1; i < kStretches; ++i) {
        IterationCost cost = measure(device, solver, iterations);
        if (cost.wall_ms < best.wall_ms)
            best = std::move(cost);
    }
    return best;
}

double sum_of(const gpu::StageTimes& stages, std::initializer_list<const char*> names)
{
    double sum = 0.0;
    for (const char* name : names)
        if (const auto stage = stages.find(name); stage != stages.end())
            sum += stage->second;
    return sum;
}

gpu::StageTimes since(const gpu::StageTimes& earlier, gpu::StageTimes now)
{
    for (const auto& [stage, ms] : earlier)
        now[stage] -= ms;
    return now;
}

SolverOptions papers_iteration(MethodOptions method)
{
    set_option(method, "scheme", "paper");
    set_option(method, "batch", "1");
    std::visit(
        [](auto& options) {
            if constexpr (shoots_from_texels<std::decay_t<decltype(options)>>)
                options.rule = SampleRule::centre;
        },
        method);
    return {.method = method};
}

NearField no_near_field(const Lumels& lumels)
{
    return {.first = std::vector<std::uint32_t>(lumels.lumels.size() + 1)};
}

}  // namespace lumel::bench
