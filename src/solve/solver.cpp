#include "solve/solver.h"

#include <algorithm>
#include <chrono>

#include "solve/directions.h"
#include "solve/gather.h"
#include "solve/glossy.h"
#include "solve/matrix.h"
#include "solve/progressive.h"
#include "solve/stochastic.h"

namespace lumel {

ViewOptions view_options(const SolverOptions& options)
{
    const std::uint32_t batch = checked_batch(method_of(options.method), options.batch);
    return {options.projection, options.hemicube, int(batch)};
}

IterationOptions iteration_options(const SolverOptions& options)
{
    return {options.scheme, options.leak};
}

TransportOptions transport_options(const SolverOptions& options)
{
    return {view_options(options), options.patches, options.bounces};
}

bool gathers_sky(const SolverOptions& options)
{
    return options.method == "directions" && options.scheme == Scheme::paper && options.sky;
}

NearFieldOptions near_field_options(const SolverOptions& options)
{
    // The table's noise does not fall with the number of shots, so its samples follow the target.
    // The default serves 2 %; how much of an error is the table's was not measured alone.
    constexpr int kSamples = 16, kMostSamples = 144;
    constexpr double kTarget = 0.02;
    double finer = 1.0;
    if (options.target_error > 0.0)
        finer = kTarget / options.target_error;
    else if (options.max_shots > 0)
        finer = double(options.max_shots) / 2048.0;
    NearFieldOptions near;
    near.samples = int(std::clamp(kSamples * finer, double(kSamples), double(kMostSamples)));
    near.centre = options.rule == SampleRule::centre;
    near.seed = options.seed;
    near.radius = method_of(options.method).near_radius;
    near.surroundings = options.method == "matrix";
    return near;
}

NearField near_field_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                         const SolverOptions& options, float radius)
{
    // Along global directions no pair is too close, nor is any to a hemicube of its own.
    if (options.scheme == Scheme::paper || options.method == "directions" ||
        options.method == "gather")
        return {};
    NearFieldOptions near = near_field_options(options);
    if (radius > 0.0f)
        near.radius = radius;
    return build_near_field(scene, rays, lumels, near);
}

const MethodInfo& method_of(const std::string& id)
{
    std::string known;
    for (const MethodInfo& info : kMethods) {
        if (id == info.id)
            return info;
        known += std::string(known.empty() ? "" : ", ") + info.id;
    }
    throw Error(ErrorKind::input, "--solver " + id, "no such method; there are: " + known);
}

std::uint32_t checked_batch(const MethodInfo& method, int batch)
{
    if (batch < 1 || std::uint32_t(batch) > method.most_batch)
        throw Error(ErrorKind::input, "--batch " + std::to_string(batch),
                    "must be from 1 to " + std::to_string(method.most_batch) +
                        " shooters with the method " + method.id);
    return std::uint32_t(batch);
}

std::unique_ptr<Solver> make_solver(const gpu::Device& device, const World& world,
                                    const Lumels& lumels, const NearField& near,
                                    const SolverOptions& options, std::span<const glm::vec3> known,
                                    const LobeParticles* particles)
{
    if (options.method == "directions")
        return std::make_unique<GlobalDirections>(device, world, lumels, options, known);
    if (options.method == "gather")
        return std::make_unique<GatherRadiosity>(device, world, lumels, options);
    if (options.method == "progressive")
        return std::make_unique<ProgressiveRadiosity>(device, world, lumels, near, options);
    if (options.method == "matrix")
        return std::make_unique<MatrixRadiosity>(device, world, lumels, near, options, known);
    if (method_of(options.method).materials == MaterialModel::glossy)
        return std::make_unique<GlossyIllumination>(device, world, lumels, near, options, known,
                                                    particles);
    return std::make_unique<StochasticRadiosity>(device, world, lumels, near, options, known);
}

bool solve(Solver& solver, const SolverOptions& options,
           const std::function<bool(const SolverState&)>& go_on)
{
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
        const SolverState state = solver.state();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (go_on && !go_on(state))
            return false;
        if (options.max_shots > 0 && state.shots >= options.max_shots)
            return true;
        if (options.max_seconds > 0.0 && seconds >= options.max_seconds)
            return true;
        if (options.target_error > 0.0 && state.error >= 0.0 && state.error <= options.target_error)
            return true;
        solver.step();
    }
}

}  // namespace lumel
