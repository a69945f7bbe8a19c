#include "jobs/solve/sources.h"

#include "methods/matrix/relight_solver.h"
#include "methods/methods.h"
#include "solve/matrix/blas.h"

namespace lumel {
namespace {

/// The sources, each with its sky's and lamps' direct light at the lumels.
std::vector<KnownSource> known_sources(const gpu::Device& device, const Setting& setting,
                                       const BakeOptions& options, DirectLight& told,
                                       Stages& stages)
{
    const SolveScene& prepared = setting.prepared;
    if (has_lights(prepared.scene))
        stages.begin("sky and lamps");
    std::vector<KnownSource> sources;
    for (LightSource& source : light_sources(prepared.scene, prepared.lumels)) {
        KnownSource& known = sources.emplace_back(KnownSource{std::move(source), {}});
        const Scene lamps = lamps_of(prepared.scene, known.source);
        if (!has_lights(lamps))
            continue;
        DirectLight light =
            direct_light(device, *setting.world, lamps, prepared.lumels,
                         direct_light_options(options.solver, options.sky_directions),
                         [&](double fraction) { return stages.progress(fraction); });
        known.direct = std::move(light.irradiance);
        told.finished = told.finished && light.finished;
        for (const auto& [stage, ms] : light.times)
            told.times[stage] += ms;
    }
    return sources;
}

FormFactorRow row_of(const Transport& transport)
{
    return {.patches = transport.patches.size(),
            .closed = transport.check.closed,
            .voxel = double(transport.patches.side),
            .reciprocity = transport.check.reciprocity,
            .row_sum = transport.check.row_sum,
            .worst_row_sum = transport.check.worst_row_sum};
}

}  // namespace

bool keeps_sources_apart(const BakeOptions& options)
{
    return method_of(options.solver.method).can_keep_sources;
}

void open_libraries(const BakeOptions& options)
{
    if (std::holds_alternative<MatrixOptions>(options.solver.method) || !options.daylight.empty())
        blas::open();
}

AtlasOptions atlas_that_fits(const BakeOptions& options)
{
    AtlasOptions atlas = options.atlas;
    if (!keeps_sources_apart(options))
        return atlas;
    if (atlas.sides == Sides::both)
        throw Error(ErrorKind::input, "--sides both",
                    "is not possible with separate sources: scene.lumelmat has one texel for both "
                    "sides of a surface");
    if (atlas.sides == Sides::automatic)
        atlas.sides = Sides::brighter;
    return atlas;
}

std::unique_ptr<Solution> solve_sources(const gpu::Device& device, const Setting& setting,
                                        const BakeOptions& options, Stages& stages)
{
    auto solution = std::make_unique<Solution>();
    const SolveScene& prepared = setting.prepared;
    std::vector<KnownSource> sources =
        known_sources(device, setting, options, solution->lamps, stages);
    if (stages.stopped())
        throw_stopped();
    stages.begin("solving");
    auto solver = std::make_unique<RelightSolver>(device, *setting.world, prepared, setting.near,
                                                  std::get<MatrixOptions>(options.solver.method),
                                                  for_what_is_left(options.solver, stages).limits(),
                                                  std::move(sources), options.parts);
    while (!solver->done() && stages.progress(solver->fraction(), solver->state().shots))
        solver->step();
    const bool needs_matrix = options.parts != Parts::direct;
    if (!solver->done() && (solver->state().shots == 0 || (needs_matrix && !solver->transport())))
        throw_stopped();
    if (solver->done())
        tell_missed(options.solver, solver->state(), stages);
    stages.note_times(solver->times());
    solution->run.finished = solver->done();
    solution->irradiance = solver->irradiance();
    if (solver->done() && solution->lamps.finished && options.parts == Parts::all)
        solution->relightable = solver->relightable(prepared.scene.hash);
    if (const Transport* transport = solver->transport())
        solution->form_factors = row_of(*transport);
    solution->solver = std::move(solver);
    return solution;
}

}  // namespace lumel
