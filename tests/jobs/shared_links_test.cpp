// Ranks that share the work of links find what one process finds, bit for bit.

#include <sstream>
#include <string>

#include "../support/closed_forms.h"
#include "../support/source_folder.h"
#include "../support/thread_ranks.h"
#include "atlas/near/buried.h"
#include "base/core/state_bytes.h"
#include "jobs/solve/host_memory.h"
#include "links/trace/links.h"
#include "solved.h"

namespace lumel {
namespace {

// Low enough for a second round, which is guided.
const SolverOptions kLimits{.target_error = 0.02};

class RanksOfLinks : public testing::Test {
protected:
    const SolveScene world{read_gltf(support::scene_path("two-rooms")), AtlasOptions{.size = 48}};
};

LinkRadiosity solver_of(const SolveScene& world, Ranks* ranks)
{
    return {nullptr, world, LinksOptions{}, kLimits.limits(), Parts::all, ranks};
}

std::vector<glm::vec3> solved(const SolveScene& world, Ranks* ranks)
{
    LinkRadiosity solver = solver_of(world, ranks);
    solve(solver, kLimits);
    return solver.irradiance();
}

/// Stopped in the second round.
std::string state_of_unfinished(const SolveScene& world, Ranks* ranks)
{
    LinkRadiosity solver = solver_of(world, ranks);
    while (solver.state().shots == 0)
        solver.step();
    solver.step();
    std::ostringstream stream;
    StateWriter writer(stream);
    solver.write_state(writer);
    return stream.str();
}

std::vector<glm::vec3> continued(const SolveScene& world, const std::string& state, Ranks* ranks)
{
    LinkRadiosity solver = solver_of(world, ranks);
    std::istringstream stream(state);
    StateReader reader(stream, state.size(), "state");
    solver.read_state(reader);
    solve(solver, kLimits);
    return solver.irradiance();
}

TEST_F(RanksOfLinks, FindTheSameLightAsOneProcess)
{
    const SolveScene cornell(read_gltf(support::scene_path("cornell-box")),
                             AtlasOptions{.size = 48});
    for (const SolveScene* scene : {&world, &cornell}) {
        const std::vector<glm::vec3> alone = solved(*scene, nullptr);
        for (const std::size_t count : {1u, 2u, 3u})
            support::run_ranks(count, [&](Ranks& ranks) {
                EXPECT_EQ(solved(*scene, &ranks), alone)
                    << scene->scene.path << ", " << count << " ranks";
                ranks.finish(0);
            });
    }
}

TEST_F(RanksOfLinks, ContinueWhatAnotherNumberOfThemHasBegun)
{
    const std::vector<glm::vec3> whole = solved(world, nullptr);
    std::string state;
    support::run_ranks(2, [&](Ranks& ranks) {
        std::string own = state_of_unfinished(world, &ranks);
        if (ranks.is_first())
            state = std::move(own);
        ranks.finish(0);
    });
    EXPECT_EQ(continued(world, state, nullptr), whole);
    support::run_ranks(3, [&](Ranks& ranks) {
        EXPECT_EQ(continued(world, state, &ranks), whole);
        ranks.finish(0);
    });
}

TEST_F(RanksOfLinks, GiveTheFirstTheLinksOfAll)
{
    const auto kept = [&](Ranks* ranks) {
        LinkRadiosity solver = solver_of(world, ranks);
        solve(solver, kLimits);
        solver.gather_links();
        return ranks && !ranks->is_first() ? StoredLinks{} : solver.kept("");
    };
    const StoredLinks alone = kept(nullptr);
    support::run_ranks(2, [&](Ranks& ranks) {
        const StoredLinks gathered = kept(&ranks);
        if (ranks.is_first()) {
            ASSERT_EQ(gathered.rounds.size(), alone.rounds.size());
            for (std::size_t r = 0; r < alone.rounds.size(); ++r) {
                EXPECT_EQ(gathered.rounds[r].rays, alone.rounds[r].rays);
                EXPECT_EQ(gathered.rounds[r].ends, alone.rounds[r].ends);
            }
        }
        ranks.finish(0);
    });
}

TEST_F(RanksOfLinks, PlanMemoryForTheirPartOfLinks)
{
    const BakeOptions alone{.solver = {.method = LinksOptions{}}};
    BakeOptions shared = alone;
    shared.ranks = 2;
    const HostMemory whole = host_memory(world, alone, false),
                     half = host_memory(world, shared, false);
    // All but the last block are full.
    EXPECT_NEAR(double(half.links) / double(whole.links), 0.5, 0.1);
    EXPECT_EQ(half.without_links(), whole.without_links());
    shared.keep_links = true;  // the first rank has all in the end
    EXPECT_EQ(host_memory(world, shared, false).links, whole.links);
}

TEST_F(RanksOfLinks, FindTheSameVisibleNoise)
{
    const SolverOptions limits{.target_quality = {.visible_noise = 0.05}};
    const SolveScene box(read_gltf(support::scene_path("cornell-box")), AtlasOptions{.size = 96});
    const auto noise = [&](Ranks* ranks) {
        LinkRadiosity solver(nullptr, box, LinksOptions{}, limits.limits(), Parts::all, ranks);
        solve(solver, limits);
        return solver.state().visible_noise.worst_chart;
    };
    const double alone = noise(nullptr);
    EXPECT_GT(alone, 0.0);
    support::run_ranks(2, [&](Ranks& ranks) {
        EXPECT_EQ(noise(&ranks), alone);
        ranks.finish(0);
    });
}

TEST(RanksOfLumels, BuryTheSame)
{
    const auto world = [](Ranks* ranks) {
        const auto lay_out = [](const Scene& scene, const RayScene&, const ProgressCallback&) {
            return make_atlas(scene, {.size = 96});
        };
        return SolveScene(read_gltf(support::scene_path("room")), lay_out,
                          [&](const Scene& scene, const RayScene& rays, const Atlas& atlas,
                              Lumels& lumels, const ProgressCallback& progress) {
                              return mark_buried(scene, rays, atlas, lumels, {}, progress, ranks);
                          });
    };
    const auto shares = [](const Lumels& lumels) {
        std::vector<float> all;
        for (const Piece& piece : lumels.pieces)
            all.push_back(piece.share);
        return all;
    };
    const SolveScene alone = world(nullptr);
    EXPECT_TRUE(
        std::ranges::any_of(alone.open, [](float one) { return one > 0.0f && one < 1.0f; }));
    support::run_ranks(3, [&](Ranks& ranks) {
        const SolveScene shared = world(&ranks);
        EXPECT_EQ(shared.open, alone.open);
        EXPECT_EQ(shares(shared.lumels), shares(alone.lumels));
        ranks.finish(0);
    });
}

}  // namespace
}  // namespace lumel
