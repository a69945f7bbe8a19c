// [BJ04] section 3.1: "This selection algorithm took almost 10 times longer than all other elements
// of rendering", stated of reading the radiosity back and searching it on the processor; and what
// replaced it, a search in sums on the device.

#include <algorithm>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/selection.draw.comp.h"
#include "bench/stopwatch.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/shooting/power_pyramid.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

constexpr int kSelectionStretches = 3;  ///< of draws; the fastest counts

/// Push constants of selection.draw.comp.
struct Power {
    std::vector<glm::vec3> radiosity;  ///< [N] B
    std::vector<glm::vec4> surface;    ///< [N] ρ, A
};

struct DrawCost {
    double cpu_ms = std::numeric_limits<double>::max();
    double wall_ms = std::numeric_limits<double>::max();
    std::vector<std::uint32_t> lumels;  ///< drawn
};

Power power_after(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    Power power{emission_of(lumels), surfaces_of(lumels)};
    for (std::size_t j = 0; j < irradiance.size(); ++j)
        power.radiosity[j] += glm::vec3(power.surface[j]) * irradiance[j];
    return power;
}

/// The lumel in which the running sum of power passes u of all of it.
std::uint32_t search(const glm::vec3* radiosity, const std::vector<glm::vec4>& surface, double u)
{
    double total = 0.0;
    for (std::size_t j = 0; j < surface.size(); ++j)
        total += luminance(radiosity[j]) * double(surface[j].w);
    double sum = 0.0;
    for (std::size_t j = 0; j < surface.size(); ++j) {
        sum += luminance(radiosity[j]) * double(surface[j].w);
        if (sum > u * total)
            return std::uint32_t(j);
    }
    return std::uint32_t(surface.size() - 1);
}

template <class Draw>
DrawCost time_draws(const std::vector<float>& numbers, const Draw& draw)
{
    DrawCost cost;
    for (int i = 0; i < kSelectionStretches; ++i) {
        Stopwatch watch;
        watch.start();
        for (std::size_t k = 0; k < numbers.size(); ++k)
            draw(k);
        watch.stop();
        cost.cpu_ms = std::min(cost.cpu_ms, 1e3 * watch.cpu / double(numbers.size()));
        cost.wall_ms = std::min(cost.wall_ms, 1e3 * watch.wall / double(numbers.size()));
    }
    return cost;
}

DrawCost by_read_back(const gpu::Device& device, const Power& power,
                      const std::vector<float>& numbers)
{
    const gpu::Array<glm::vec3> source(device, view(power.radiosity));
    const gpu::Array<glm::vec3> host(device, source.size(), gpu::Buffer::Place::host);
    gpu::Commands commands(device);
    std::vector<std::uint32_t> lumels(numbers.size());
    DrawCost cost = time_draws(numbers, [&](std::size_t k) {
        commands.copy(source.buffer(), host.buffer(), source.size() * sizeof(glm::vec3));
        commands.run();
        lumels[k] = search(host.mapped(), power.surface, double(numbers[k]));
    });
    cost.lumels = std::move(lumels);
    return cost;
}

DrawCost on_device(const gpu::Device& device, const Power& power, const std::vector<float>& numbers)
{
    const gpu::Array<glm::vec3> source(device, view(power.radiosity));
    const gpu::Array<glm::vec4> surface(device, view(power.surface));
    const gpu::Array<std::uint32_t> lumels(device, numbers.size());
    const gpu::Kernel<shaders::SelectionDraw> draw(device);
    PowerPyramid pyramid(device, source.size());
    gpu::Commands commands(device);
    DrawCost cost = time_draws(numbers, [&](std::size_t k) {
        pyramid.build(commands, source, surface, 0.0f, 0.0f);
        commands.dispatch(draw, {.weights = pyramid.array(), .lumels = lumels},
                          DrawParams{pyramid.layout(), numbers[k], std::uint32_t(k)}, 1);
        commands.run();
    });
    cost.lumels = lumels.download();
    return cost;
}

/// Numbers for which both found the same lumel, or its neighbour: their sums are rounded
/// differently.
std::size_t agreeing(const DrawCost& a, const DrawCost& b)
{
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.lumels.size(); ++k)
        count += std::max(a.lumels[k], b.lumels[k]) - std::min(a.lumels[k], b.lumels[k]) <= 1;
    return count;
}

std::vector<float> draw_numbers(int count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform;
    std::vector<float> numbers(static_cast<std::size_t>(count));
    for (float& number : numbers)
        number = uniform(random);
    return numbers;
}

}  // namespace

void time_selection(const SelectionSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const SolverOptions options = papers_iteration(settings.shared.given.options());
    report.say(fmt::format("{}, {}", settings.shared.scene, words_of(device)));
    report.table("selection", "Time of drawing a shooter ([BJ04] section 3.1)",
                 {"map", "lumels", "read-back, cpu ms", "read-back, wall ms", "device, cpu ms",
                  "device, wall ms", "read-back / device", "rest of an iteration, ms",
                  "read-back / rest", "device / rest", "same lumel"},
                 kNoShooters);
    const std::vector<float> numbers = draw_numbers(settings.draws, seed_of(options.method));
    double largest = 0.0;  // read-back over the rest
    for (const int size : settings.sizes) {
        const SolveScene world = prepare(settings.shared, size);
        const World resident(device, world.scene, world.lumels);
        const NearField none = no_near_field(world.lumels);
        const auto solver = make_solver({&device, &resident, world.lumels, none}, options);
        const IterationCost iteration = cost_of_iteration(device, *solver, settings.draws);
        const Power power = power_after(world.lumels, solver->irradiance());
        const DrawCost host = by_read_back(device, power, numbers);
        const DrawCost gpu = on_device(device, power, numbers);
        const double rest =
            iteration.wall_ms - gpu.wall_ms - sum_of(iteration.stages, {"figures", "polish"});
        report.row({fmt::format("{}²", size), world.lumels.lumels.size(), fixed(host.cpu_ms, 3),
                    fixed(host.wall_ms, 3), fixed(gpu.cpu_ms, 3), fixed(gpu.wall_ms, 3),
                    fixed(host.wall_ms / gpu.wall_ms, 1), fixed(rest, 2),
                    fixed(host.wall_ms / rest, 2), fixed(gpu.wall_ms / rest, 2),
                    fmt::format("{} of {}", agreeing(host, gpu), numbers.size())});
        largest = host.wall_ms / rest;
    }
    report.table("summary", "In short, wall time", {"what", "map", "value"}, kNoShooters);
    report.row({"read-back / rest", fmt::format("{}²", settings.sizes.back()), fixed(largest, 2)});
    device.check_validation();
}

}  // namespace lumel::bench
