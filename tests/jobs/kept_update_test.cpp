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

/// A bake of the Cornell box, with its links.
struct Kept {
    Kept()
    {
        BakeOptions options;
        options.atlas.size = 64;
        options.preview_width = 0;
        options.keep_links = 16;
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

void expect_as_anew(const EditedScene& edit, const Kept& kept)
{
    const KeptLightOptions options{.rays = 16, .seed = kept.links.seed};
    const StoredLinks mine = links_for(edit, kept.links);
    const SolveScene& now = edit.now;
    LinkRelighter over(now, options, &mine);
    LinkRelighter anew(now, options);
    EXPECT_GT(over.links().traced().all(), 0u);
    EXPECT_LT(3 * over.links().traced().all(), anew.links().traced().all());
    std::size_t different = 0;
    for (std::size_t i = 0; i < now.lumels.lumels.size(); ++i)
        for (std::uint32_t k = 0; k < options.rays; ++k)
            different += over.links().of(i)[k] != anew.links().of(i)[k];
    EXPECT_EQ(different, 0u);
    EXPECT_TRUE(over.irradiance() == anew.irradiance());
    EXPECT_EQ(over.kept("").lumels, anew.kept("").lumels);
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

TEST(KeptUpdate, OfThingsInAnotherOrderTracesNone)
{
    const Kept kept;
    Scene now = box();
    std::reverse(now.instances.begin(), now.instances.end());
    const EditedScene edit = kept.edited(std::move(now));
    const StoredLinks mine = links_for(edit, kept.links);
    const LinkRelighter over(edit.now, {.rays = 16, .seed = kept.links.seed}, &mine);
    EXPECT_EQ(over.links().traced().all(), 0u);
}

TEST(KeptUpdate, UsesNoLinksOfAnotherNumberOfInstances)
{
    const Kept kept;
    const EditedScene edit = kept.edited(box());
    for (const std::size_t count : {std::size_t(0), edit.before.scene.instances.size() - 1,
                                    edit.before.scene.instances.size() + 1}) {
        StoredLinks forged = kept.links;
        forged.instances.resize(count);
        EXPECT_TRUE(links_for(edit, forged).links.empty());
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
