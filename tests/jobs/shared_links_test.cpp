// Ranks that share the work of links find what one process finds, bit for bit.

#include "../support/closed_forms.h"
#include "../support/source_folder.h"
#include "../support/thread_ranks.h"
#include "links/trace/links.h"
#include "solved.h"

namespace lumel {
namespace {

std::vector<glm::vec3> solved(const SolveScene& world, Ranks* ranks)
{
    // Low enough for a second round, which is guided.
    const SolverOptions limits{.target_error = 0.02};
    LinkRadiosity solver(nullptr, world, LinksOptions{}, limits.limits(), Parts::all, ranks);
    solve(solver, limits);
    return solver.irradiance();
}

TEST(RanksOfLinks, FindTheSameLightAsOneProcess)
{
    for (const char* scene : {"cornell-box", "two-rooms"}) {
        const SolveScene world(read_gltf(support::scene_path(scene)), AtlasOptions{.size = 48});
        const std::vector<glm::vec3> alone = solved(world, nullptr);
        for (const std::size_t count : {1u, 2u, 3u})
            support::run_ranks(count, [&](Ranks& ranks) {
                EXPECT_EQ(solved(world, &ranks), alone) << scene << ", " << count << " ranks";
                ranks.finish(0);
            });
    }
}

}  // namespace
}  // namespace lumel
