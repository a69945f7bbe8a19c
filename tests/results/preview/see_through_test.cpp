// Images of what lies behind glass and blended surfaces.

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "../../atlas/packing/shapes.h"
#include "../files/hand_atlas.h"
#include "results/preview/preview.h"

namespace lumel {
namespace {

constexpr int kWidth = 8;
constexpr glm::vec3 kWall(0.5f, 0.4f, 0.25f);  ///< radiance of the wall [cd/m²]
constexpr double kRounding = 1e-5;

/// Panes of 1 × 1 m in front of the left half of a wall, all under π lx. Pane 0 is farthest.
Scene wall_behind(const std::vector<Material>& panes)
{
    Scene scene = test::empty_scene();
    scene.materials.front().base_color = glm::vec4(kWall, 1.0f);
    test::add_instance(scene, test::add_mesh(scene, {test::quad(2.0f, 1.0f)}));
    float depth = 0.0f;
    for (const Material& material : panes) {
        Primitive pane = test::quad(1.0f, 1.0f);
        pane.material = int(scene.materials.size());
        scene.materials.push_back(material);
        depth += 0.1f;
        test::add_instance(scene, test::add_mesh(scene, {pane}),
                           glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, depth}));
    }
    return scene;
}

/// The wall fills the image if it is there.
Image picture_of(const Scene& scene, PreviewShows shows = PreviewShows::light)
{
    const gpu::Device device;
    const Atlas atlas = test::corner_atlas(scene);
    Image map(atlas.width, atlas.height, 4);
    for (std::size_t i = 0; i < map.values.size(); ++i)
        map.values[i] = i % 4 == 3 ? 1.0f : std::numbers::pi_v<float>;
    View view{.aspect = 2.0f, .orthographic_height = 1.0f};
    view.transform[3] = glm::vec4(1.0f, 0.5f, 3.0f, 1.0f);
    Image picture = render_preview(device, scene, atlas, map, view, kWidth, shows);
    EXPECT_EQ(device.validation_messages(), "");
    return picture;
}

/// Middle of the left half.
glm::vec4 behind_panes(const Image& picture)
{
    const float* const pixel = picture.at(picture.width / 4, picture.height / 2);
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

void expect_color(const glm::vec4& found, const glm::vec3& wanted)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], wanted[c], kRounding) << c;
}

Material glass(const glm::vec3& color, float transmission)
{
    return {.base_color = glm::vec4(color, 1.0f), .transmission = transmission};
}

Material blended(const glm::vec3& color, float alpha)
{
    return {.base_color = glm::vec4(color, alpha), .alpha_mode = AlphaMode::blend};
}

TEST(SeeThrough, ClearGlassIsNotSeen)
{
    expect_color(behind_panes(picture_of(wall_behind({glass(glm::vec3(1.0f), 1.0f)}))), kWall);
}

TEST(SeeThrough, GlassTintsWhatIsBehindAndAddsTheLightOfItsOpaqueShare)
{
    const glm::vec3 color(0.2f, 0.9f, 0.6f);
    const Image picture = picture_of(wall_behind({glass(color, 0.75f)}));
    expect_color(behind_panes(picture), 0.25f * color + 0.75f * color * kWall);
    EXPECT_FLOAT_EQ(behind_panes(picture).a, 1.0f);
    EXPECT_FLOAT_EQ(picture.at(3 * picture.width / 4, picture.height / 2)[0], kWall.r);
}

TEST(SeeThrough, BlendedSurfacesCoverTheirAlpha)
{
    const glm::vec3 color(0.2f, 0.9f, 0.6f);
    for (const float alpha : {0.0f, 0.3f, 0.7f, 1.0f})
        expect_color(behind_panes(picture_of(wall_behind({blended(color, alpha)}))),
                     alpha * color + (1.0f - alpha) * kWall);
}

TEST(SeeThrough, EachPaneTintsThoseBehindIt)
{
    const glm::vec3 color(0.2f, 0.9f, 0.6f);
    const std::vector<Material> panes(3, glass(color, 1.0f));
    expect_color(behind_panes(picture_of(wall_behind(panes))), color * color * color * kWall);
}

TEST(SeeThrough, PanesBehindAWallAreHidden)
{
    Scene scene = wall_behind({glass(glm::vec3(0.1f), 0.5f)});
    scene.instances.back().transform[3].z = -1.0f;
    expect_color(behind_panes(picture_of(scene)), kWall);
}

/// Alpha says how much the sky behind the image is hidden, the colour is that of the pane alone.
TEST(SeeThrough, APaneBeforeNothingLeavesTheRestToTheSky)
{
    const glm::vec3 color(0.2f, 0.9f, 0.6f);
    Scene scene = wall_behind({blended(color, 0.25f)});
    scene.instances.erase(scene.instances.begin());
    const glm::vec4 found = behind_panes(picture_of(scene));
    expect_color(found, color);
    EXPECT_NEAR(found.a, 0.25, kRounding);
}

TEST(SeeThrough, MapsAreShownOnTheNearestSurfaceThatIsHalfOpaque)
{
    const auto shown = [](const Material& pane) {
        Scene scene = wall_behind({pane});
        scene.instances.erase(scene.instances.begin());
        return behind_panes(picture_of(scene, PreviewShows::map)).a;
    };
    EXPECT_EQ(shown(glass(glm::vec3(1.0f), 0.4f)), 1.0f);
    EXPECT_EQ(shown(glass(glm::vec3(1.0f), 0.6f)), 0.0f);
    EXPECT_EQ(shown(blended(glm::vec3(1.0f), 0.6f)), 1.0f);
    EXPECT_EQ(shown(blended(glm::vec3(1.0f), 0.4f)), 0.0f);
}

}  // namespace
}  // namespace lumel
