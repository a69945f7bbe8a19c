#include "jobs/edit/kept_solution.h"

#include "atlas/lumels/sides.h"
#include "base/core/error.h"

namespace lumel {

void check_keep_links(const BakeOptions& options)
{
    if (options.keep_links == 0)
        return;
    const auto refuse = [](const std::string& what, const std::string& why) {
        throw Error(ErrorKind::input, "--keep-links with " + what, "is not possible: " + why);
    };
    const auto* links = std::get_if<LinksOptions>(&options.solver.method);
    if (!links)
        refuse("another solver", "only --solver links has links");
    side_of_rays(options.keep_links);
    if (options.parts != Parts::all)
        refuse("--only", "stored links are lit by all light");
    if (options.resume)
        refuse("--resume", "it has no checkpoints");
    if (links->rule == SampleRule::centre)
        refuse("--sampling centre", "their rays start all over each lumel");
    if (links->rays == Rays::query || links->rays == Rays::raster)
        refuse("--rays query or raster", "stored links are traced on the CPU");
}

KeptLightOptions kept_light_options(std::uint32_t rays, const LinksOptions& links)
{
    KeptLightOptions options{.rays = rays, .seed = links.seed};
    options.light.seed = links.seed;
    options.filter = links.filter;
    return options;
}

StoredLinks links_for(const EditedScene& edit, const StoredLinks& before)
{
    const Lumels &then = edit.before.lumels, &now = edit.now.lumels;
    // A larger atlas rounds coordinates differently; and a file can belong to another scene.
    if (then.width != now.width || then.lumels.size() != before.lumels.size() ||
        edit.before.scene.instances.size() != before.instances.size())
        return {};
    const std::vector<std::uint32_t> places = lumels_by_side(now);
    Renumbering numbers{.instances = edit.matches.after,
                        .lumels_now = now.lumels.size(),
                        .instances_now = edit.now.scene.instances.size()};
    for (const Lumel& lumel : then.lumels) {
        const std::uint32_t j = places[place_by_side(lumel)];
        const bool is_same =
            j != kNoLumel && now.lumels[j].instance == edit.matches.after[lumel.instance];
        numbers.lumels.push_back(is_same ? j : Renumbering::kNotThere);
    }
    return renumbered(before, numbers);
}

KeptLinksSolver::KeptLinksSolver(const SolveScene& prepared, const KeptLightOptions& options,
                                 Stages& stages, const StoredLinks* kept)
{
    stages.begin("links");
    light_.emplace(prepared, options, kept, stages.callback());
    stages.begin("solving");
    irradiance_ = light_->irradiance(stages.callback());
}

SolverState KeptLinksSolver::state() const
{
    return {.shots = light_->links().rays(),
            .iterations = std::uint64_t(light_->sweeps()),
            .error = light_->error().all,
            .dark_error = light_->error().dark};
}

std::unique_ptr<Solution> solve_over_kept_links(const Setting& setting, const BakeOptions& options,
                                                Stages& stages)
{
    auto solution = std::make_unique<Solution>();
    auto solver = std::make_unique<KeptLinksSolver>(
        setting.prepared,
        kept_light_options(options.keep_links, std::get<LinksOptions>(options.solver.method)),
        stages);
    solution->run.finished = true;
    const SolverState state = solver->state();
    solution->run.curve = {{state.shots, stages.stage_seconds(), state.error}};
    solution->irradiance = solver->irradiance();
    solution->links = solver->light().kept(setting.prepared.scene.hash);
    solution->solver = std::move(solver);
    return solution;
}

}  // namespace lumel
