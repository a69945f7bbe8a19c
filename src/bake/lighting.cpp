#include "bake/lighting.h"

namespace lumel {
namespace {

/// Surfaces that shine but reflect nothing.
Lumels black(Lumels lumels)
{
    for (Lumel& lumel : lumels.lumels)
        lumel.albedo = glm::vec3(0.0f);
    for (Gloss& gloss : lumels.gloss)
        gloss.diffuse = gloss.specular = glm::vec3(0.0f);
    return lumels;
}

/// Surfaces that do not shine.
Lumels dark(Lumels lumels)
{
    for (Lumel& lumel : lumels.lumels)
        lumel.emission = glm::vec3(0.0f);
    return lumels;
}

std::unique_ptr<Solution> run(const gpu::Device& device, const Setting& setting,
                              const SolverOptions& options, Lumels lumels, Stages& stages)
{
    auto solution = std::make_unique<Solution>();
    solution->lumels = std::move(lumels);
    solution->solver =
        make_solver(device, setting.resident, solution->lumels, setting.near, options);
    solution->run = solve_in_stage(*solution->solver, options, stages);
    solution->irradiance = solution->solver->irradiance();
    return solution;
}

}  // namespace

std::vector<glm::vec3> light_of_lamps(const gpu::Device& device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages)
{
    const Scene& scene = setting.world.scene;
    const Lumels& lumels = setting.world.lumels;
    if (!has_lights(scene))
        return std::vector<glm::vec3>(lumels.lumels.size(), glm::vec3(0.0f));
    stages.begin("sky and lamps");
    return direct_light(device, setting.resident, scene, lumels,
                        {.sky_directions = gathers_sky(options.solver) ? 0 : options.sky_directions,
                         .seed = options.solver.seed,
                         .centre = options.solver.rule == SampleRule::centre},
                        [&](double fraction) { return stages.tell(fraction); })
        .irradiance;
}

Lumels shining(const Lumels& lumels, const std::vector<glm::vec3>& light)
{
    Lumels result = lumels;
    for (std::size_t i = 0; i < light.size(); ++i)
        result.lumels[i].emission += result.lumels[i].albedo * light[i];
    return result;
}

void add_light(std::vector<glm::vec3>& sum, const std::vector<glm::vec3>& more)
{
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += more[i];
}

std::unique_ptr<Solution> solve_light(const gpu::Device& device, const Setting& setting,
                                      const BakeOptions& options, Stages& stages)
{
    const Lumels& lumels = setting.world.lumels;
    std::vector<glm::vec3> direct = light_of_lamps(device, setting, options, stages);
    if (options.parts == Parts::all) {
        std::unique_ptr<Solution> all =
            run(device, setting, options.solver, shining(lumels, direct), stages);
        add_light(all->irradiance, direct);
        return all;
    }
    std::unique_ptr<Solution> first = run(device, setting, options.solver, black(lumels), stages);
    add_light(first->irradiance, direct);
    if (options.parts == Parts::direct)
        return first;
    SolverOptions onward = options.solver;
    onward.sky = false;
    return run(device, setting, onward, shining(dark(lumels), first->irradiance), stages);
}

}  // namespace lumel
