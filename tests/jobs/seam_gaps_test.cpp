// Seams of whole scenes before and after they are matched.

#include "atlas/finish/finish.h"
#include "solved.h"

namespace lumel {
namespace {

struct Case {
    const char* scene;
    int size;           ///< of the atlas [texels]
    float sky;          ///< from everywhere [cd/m²], beside the scene's own light
    double times_less;  ///< that the gap becomes, at least
};

class Seams : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Of, Seams,
                         testing::Values(Case{"three-balls", 256, 1000.0f, 4.0},
                                         Case{"room", 512, 0.0f, 4.0}),
                         [](const auto& test) {
                             std::string name = test.param.scene;
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(Seams, AreSmallerOnceTheyAreMatched)
{
    LightOptions lights;
    if (GetParam().sky > 0.0f)
        lights.sky_color = glm::vec3(GetParam().sky);
    const SolveScene world(
        read_scene(support::scene_path(GetParam().scene), MaterialModel::diffuse, lights),
        AtlasOptions{.size = GetParam().size});
    const support::Solved solved =
        support::solve_scene(world, {.method = LinksOptions{}, .target_error = 0.03});
    Image before = to_map(world.lumels, solved.irradiance);
    fill_buried(before, world.lumels, shown_lumels(world.lumels, solved.irradiance));
    dilate(before);
    Image after = before;
    match_seams(after, world.scene, world.atlas, world.lumels);
    const SeamGaps was = seam_gaps(before, before, world.scene, world.atlas);
    const SeamGaps is = seam_gaps(after, before, world.scene, world.atlas);
    std::printf("%s: %.0f texels of seams, gap %.3f %% before, %.3f %% after; light jumps at %.1f "
                "%% of them\n",
                GetParam().scene, was.length, 100.0 * was.gap, 100.0 * is.gap, 100.0 * was.jumping);
    EXPECT_GT(was.length, 100.0);
    EXPECT_LT(is.gap, was.gap / GetParam().times_less);
}

}  // namespace
}  // namespace lumel
