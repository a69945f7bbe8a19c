// Links of a bake serve its scene after things have appeared and vanished.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <glm/gtc/matrix_transform.hpp>

#include "../support/temporary_folder.h"
#include "jobs/bake/bake.h"
#include "jobs/edit/kept_solution.h"
#include "jobs/relight/relight.h"
#include "links/kept/links_file.h"
#include "results/record/bake_record.h"
#include "solved.h"

namespace lumel {
namespace {

SolverOptions even(std::uint32_t rays)
{
    SolverOptions options;
    options.method = LinksOptions{.even_rays = rays};
    options.target_error = 0.0;
    return options;
}

/// A bake of the Cornell box, with its links.
struct Kept {
    Kept()
    {
        BakeOptions options;
        options.atlas.size = 64;
        options.preview_width = 0;
        options.keep_links = true;
        options.solver = even(24);
        bake(support::scene_path("cornell-box"), path(), options);
        record = read_bake_record(path());
        links = read_links(path() + "/scene.lumellinks");
        solution = read_solution(path() + "/solution.exr");
    }
    std::string path() const { return folder / "out"; }
    EditedScene edited(Scene now) const
    {
        return EditedScene(read_scene(path() + "/scene.glb", MaterialModel::diffuse, {}),
                           std::move(now), solution, record,
                           [&](const Scene& scene, const RayScene&, const ProgressCallback&) {
                               return atlas_of(links, scene, record.pages);
                           });
    }

    test::TemporaryFolder folder;
    BakeRecord record;
    StoredLinks links;
    StoredSolution solution;
};

std::unique_ptr<KeptSolution> lit(const EditedScene& edit, const Kept& kept,
                                  const StoredLinks& links)
{
    auto solution =
        std::make_unique<KeptSolution>(edit.now, kept.record, links, LinkRadiosity::Then::add);
    solution->light({});
    return solution;
}

void expect_as_anew(const EditedScene& edit, const Kept& kept)
{
    const StoredLinks mine = links_for(edit, kept.links), none;
    const auto one = lit(edit, kept, mine), other = lit(edit, kept, none);
    LinkRadiosity *const over = &one->solver(), *const anew = &other->solver();
    EXPECT_GT(over->traced(), 0u);
    EXPECT_LT(2 * over->traced(), anew->traced());
    const StoredLinks found = over->kept(""), wanted = anew->kept("");
    ASSERT_EQ(found.rounds.size(), wanted.rounds.size());
    EXPECT_EQ(found.rounds[0].rays, wanted.rounds[0].rays);
    EXPECT_TRUE(found.rounds[0].ends == wanted.rounds[0].ends);
    EXPECT_TRUE(over->irradiance() == anew->irradiance());
    EXPECT_EQ(found.lumels, wanted.lumels);
}

Scene box()
{
    return read_gltf(support::scene_path("cornell-box"));
}

TEST(KeptUpdate, OfAThingThatVanishedTracesFewLinksToThoseOfANewTracing)
{
    const Kept kept;
    Scene now = box();
    now.instances.erase(now.instances.begin() + find_instance(now, "short block"));
    const EditedScene edit = kept.edited(std::move(now));
    ASSERT_LT(edit.now.lumels.lumels.size(), kept.links.lumels.size());
    expect_as_anew(edit, kept);
}

TEST(KeptUpdate, OfAThingThatAppearedBeforeAllOthersTracesFewLinksToThoseOfANewTracing)
{
    const Kept kept;
    Scene now = box();
    Instance copy = now.instances[find_instance(now, "short block")];
    copy.name = "copy";
    copy.transform =
        glm::scale(glm::translate(copy.transform, glm::vec3(0.0f, 0.3f, 0.0f)), glm::vec3(0.5f));
    now.instances.insert(now.instances.begin(), copy);
    const EditedScene edit = kept.edited(std::move(now));
    ASSERT_EQ(edit.now.lumels.width, edit.before.lumels.width);
    ASSERT_GT(edit.now.lumels.lumels.size(), kept.links.lumels.size());
    expect_as_anew(edit, kept);
}

TEST(KeptUpdate, OfThingsInAnotherOrderTracesNoneButNearOnes)
{
    const Kept kept;
    Scene now = box();
    std::reverse(now.instances.begin(), now.instances.end());
    const EditedScene edit = kept.edited(std::move(now));
    const StoredLinks mine = links_for(edit, kept.links);
    std::size_t near = 0;
    for (const std::vector<LinkEnd>& ends : kept.links.rounds[0].ends)
        near += std::size_t(std::count(ends.begin(), ends.end(), LinkEnd::of(LinkNumbers::kNear)));
    EXPECT_EQ(lit(edit, kept, mine)->solver().traced(), near);
}

TEST(KeptUpdate, UsesNoLinksOfAnotherNumberOfInstances)
{
    const Kept kept;
    const EditedScene edit = kept.edited(box());
    for (const std::size_t count : {std::size_t(0), edit.before.scene.instances.size() - 1,
                                    edit.before.scene.instances.size() + 1}) {
        StoredLinks forged = kept.links;
        forged.instances.resize(count);
        EXPECT_TRUE(links_for(edit, forged).rounds.empty());
    }
}

TEST(KeptRelight, StopsWithinAStateAndKeepsThoseBefore)
{
    const Kept kept;
    const std::string states = kept.folder / "states.json";
    std::ofstream(states) << R"({"states": [{"name": "one"}, {"name": "two"}]})";
    double last = 0.0;
    const RelightSummary summary = relight(kept.path(), states, {}, [&](const BakeProgress& now) {
        last = now.fraction;
        return !(now.stage == "states" && now.fraction > 0.5 && now.fraction < 1.0);
    });
    EXPECT_TRUE(summary.interrupted);
    ASSERT_EQ(summary.states.size(), 1u);
    EXPECT_TRUE(std::filesystem::exists(kept.path() + "/states/one.exr"));
    EXPECT_FALSE(std::filesystem::exists(kept.path() + "/states/two.exr"));
    EXPECT_LT(last, 1.0);
}

TEST(KeptRelight, ThatIsStoppedInItsFirstStateLeavesNoFolder)
{
    const Kept kept;
    const std::string states = kept.folder / "states.json";
    std::ofstream(states) << R"({"states": [{"name": "one"}]})";
    const RelightSummary summary = relight(kept.path(), states, {}, [](const BakeProgress& now) {
        return !(now.stage == "states" && now.fraction > 0.0);
    });
    EXPECT_TRUE(summary.interrupted);
    EXPECT_FALSE(std::filesystem::exists(kept.path() + "/states"));
}

}  // namespace
}  // namespace lumel
