#include "jobs/edit/kept_solution.h"

#include <algorithm>

#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "methods/methods.h"

namespace lumel {
namespace {

/// Progress at the first estimate.
constexpr double kFirstLight = 0.9;

/// Targets and limits of the bake. Targets that it missed are replaced by what it reached.
SolverOptions limits_of(const BakeRecord& baked)
{
    SolverOptions options = reached_targets(baked);
    options.max_shots = ray_limit(baked);
    options.max_seconds = 0.0;
    options.max_bytes = free_bytes_for_links();
    return options;
}

}  // namespace

void check_keep_links(const BakeOptions& options)
{
    if (options.keep_links && !std::holds_alternative<LinksOptions>(options.solver.method))
        throw Error(ErrorKind::input, "--keep-links with another solver",
                    "is not possible: only --solver links has links");
    if (options.keep_links && options.compression == Compression::draco)
        throw Error(ErrorKind::input, "--keep-links with --compress draco",
                    "is not possible: stored links need the exact triangles of scene.glb; use "
                    "--compress meshopt");
}

void check_links(const StoredLinks& links, const BakeRecord& baked, const std::string& path)
{
    if (links.scene_hash != baked.scene_hash || links.shots() != baked.keep_links ||
        !std::holds_alternative<LinksOptions>(baked.solver.method))
        throw Error(ErrorKind::input, path,
                    "belongs to another scene or bake than the one in this folder; bake the scene "
                    "with --keep-links again");
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

KeptSolution::KeptSolution(const SolveScene& scene, const BakeRecord& baked,
                           const StoredLinks& links, LinkRadiosity::Then then)
    : options_(limits_of(baked)),
      solver_(scene, std::get<LinksOptions>(options_.method), options_.limits(), baked.parts)
{
    if (!links.rounds.empty())
        solver_.use(links, then);
}

void KeptSolution::light(const ProgressCallback& progress)
{
    solver_.relight();
    // The solver enforces the ray limit itself, after it has refined direct light.
    SolverOptions options = options_;
    options.max_shots = 0;
    solve(solver_, options, [&](const SolverState& state) {
        notify(progress, state.shots > 0 ? kFirstLight : kFirstLight * state.begun);
        return true;
    });
}

}  // namespace lumel
