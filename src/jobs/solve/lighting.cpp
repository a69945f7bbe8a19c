#include "jobs/solve/lighting.h"

#include "methods/methods.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

/// Lumels without emission.
Lumels dark(Lumels lumels)
{
    for (Lumel& lumel : lumels.lumels)
        lumel.emission = glm::vec3(0.0f);
    return lumels;
}

std::unique_ptr<Solution>
run(const gpu::Device* device, const Setting& setting, const SolverOptions& options,
    std::optional<Lumels> changed, std::span<const glm::vec3> known, Stages& stages,
    const LobeParticles* particles, Parts parts = Parts::all, Checkpoint* checkpoint = nullptr,
    std::span<const glm::vec3> first_emission = {}, Ranks* ranks = nullptr)
{
    auto solution = std::make_unique<Solution>();
    solution->lumels = std::move(changed);
    const Lumels& lumels = solution->lumels ? *solution->lumels : setting.prepared.lumels;
    solution->solver = make_solver({.device = device,
                                    .world = setting.world ? &*setting.world : nullptr,
                                    .lumels = lumels,
                                    .near = setting.near,
                                    .known = known,
                                    .particles = particles,
                                    .first_emission = first_emission,
                                    .scene = &setting.prepared,
                                    .parts = parts,
                                    .ranks = ranks},
                                   options);
    solution->run = solve_in_stage(*solution->solver, options, stages, checkpoint, ranks);
    solution->irradiance = solution->solver->irradiance();
    return solution;
}

/// direct: [N] [lx] light of sky and lamps, or empty.
std::unique_ptr<Solution> solve_parts(const gpu::Device* device, const Setting& setting,
                                      const BakeOptions& options,
                                      const std::vector<glm::vec3>& direct, Stages& stages,
                                      Checkpoint* checkpoint, Ranks* ranks)
{
    const Lumels& lumels = setting.prepared.lumels;
    const LobeParticles* particles = setting.carriers();
    if (method_of(options.solver.method).finds_lights)
        return run(device, setting, options.solver, {}, {}, stages, particles, options.parts,
                   checkpoint, {}, ranks);
    if (options.parts == Parts::all || finds_emitted(options.solver.method, lumels, {})) {
        std::unique_ptr<Solution> found =
            run(device, setting, options.solver,
                shining(lumels, direct, particles ? Lobes::carried : Lobes::diffuse), direct,
                stages, particles, options.parts);
        if (options.parts != Parts::indirect)
            add_light(found->irradiance, direct);
        return found;
    }
    std::unique_ptr<Solution> first =
        run(device, setting, options.solver, black(lumels), direct, stages, nullptr);
    add_light(first->irradiance, direct);
    if (options.parts == Parts::direct)
        return first;
    SolverOptions onward = options.solver;
    if (auto* directions = std::get_if<DirectionsOptions>(&onward.method))
        directions->sky = false;
    if (!particles)
        return run(device, setting, onward, shining(dark(lumels), first->irradiance), {}, stages,
                   nullptr);
    return run(device, setting, onward, shining(dark(lumels), first->irradiance, Lobes::carried),
               first->irradiance, stages, particles, Parts::all, nullptr, emission_of(lumels));
}

}  // namespace

DirectLightOptions direct_light_options(const SolverOptions& solver, std::uint32_t sky_directions)
{
    return {.sky_directions = gathers_sky(solver.method) ? 0 : sky_directions,
            .seed = seed_of(solver.method),
            .centre = rule_of(solver.method) == SampleRule::centre};
}

DirectionalOptions directional_options(const BakeOptions& options, std::uint64_t solver_shots)
{
    const ViewOptions views = views_of(options.solver.method);
    return {.kind = options.directional,
            .rule = rule_of(options.solver.method),
            .seed = seed_of(options.solver.method),
            .batch = std::uint32_t(views.batch),
            .projection = views.projection,
            .hemicube = std::uint32_t(views.hemicube),
            .shots = directional_shots(batch_of(options.solver.method) > 0 ? solver_shots : 0)};
}

DirectLight light_of_lamps(const gpu::Device* device, const Setting& setting,
                           const BakeOptions& options, Stages& stages)
{
    if (!has_lights(setting.prepared.scene) || method_of(options.solver.method).finds_lights)
        return {};
    stages.begin("sky and lamps");
    DirectLight light =
        direct_light(*device, *setting.world, setting.prepared.scene, setting.prepared.lumels,
                     direct_light_options(options.solver, options.sky_directions),
                     [&](double fraction) { return stages.progress(fraction); });
    stages.note_times(light.times);
    return light;
}

std::optional<Lumels> shining(const Lumels& lumels, const std::vector<glm::vec3>& light,
                              Lobes lobes)
{
    if (light.empty())
        return {};
    Lumels result = lumels;
    for (std::size_t i = 0; i < light.size(); ++i)
        result.lumels[i].emission +=
            (lobes == Lobes::carried ? result.gloss[i].diffuse : result.lumels[i].albedo) *
            light[i];
    return result;
}

std::unique_ptr<Solution> solve_light(const gpu::Device* device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages,
                                      Checkpoint* checkpoint, Ranks* ranks)
{
    DirectLight lamps = light_of_lamps(device, setting, options, stages);
    std::unique_ptr<Solution> solution =
        solve_parts(device, setting, options, lamps.irradiance, stages, checkpoint, ranks);
    solution->lamps = std::move(lamps);
    return solution;
}

}  // namespace lumel
