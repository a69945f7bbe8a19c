// Pictures of glossy scenes, against path tracing.

#include "jobs/render/render.h"

#include <algorithm>
#include <cmath>

#include "../support/box_lumels.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr double kBelowLamps = 3.0;  ///< [cd/m²] dimmer than the lamps, brighter than all else

RenderOptions small(std::uint64_t shots)
{
    RenderOptions options;
    options.width = 72;
    options.height = 48;
    options.sets = 16;
    options.bake.atlas.size = 96;
    options.bake.solver.max_shots = shots;
    options.bake.solver.target_error = 0.0;
    return options;
}

/// Where the quality of the light does not matter.
RenderOptions rough(std::uint64_t shots)
{
    RenderOptions options = small(shots);
    options.bake.atlas.size = 48;
    return options;
}

Scene glossy_scene(const std::string& name)
{
    return read_gltf(support::scene_path(name), MaterialModel::glossy);
}

Image picture(const std::string& name, const RenderOptions& options)
{
    return render(glossy_scene(name), options).image;
}

Image path_traced(const std::string& name, RenderOptions options, int paths)
{
    options.paths = paths;
    return picture(name, options);
}

/// Of all pixels.
glm::dvec4 mean(const Image& image)
{
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        sum[int(i % 4)] += double(image.values[i]);
    return sum * 4.0 / double(image.values.size());
}

TEST(Picture, OfARoomWithAPolishedFloorIsWhatPathsFind)
{
    const RenderOptions options = small(8192);
    const MapError error = compare_maps(picture("glossy-floor", options),
                                        path_traced("glossy-floor", options, 4096), kBelowLamps);
    EXPECT_LE(error.relative_rmse, 0.03);
    EXPECT_LE(std::abs(error.bias), 0.01);
}

/// True if a pixel or one beside it shows a lamp: its edge is a matter of where pixels are looked
/// through.
bool is_beside_lamp(const Image& truth, int x, int y)
{
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.width - 1); ++u)
            if (truth.at(u, v)[0] > kBelowLamps)
                return true;
    return false;
}

/// Relative RMSE away from lamps, free of the noise of two halves of a reference: the product of
/// the deviations from them has the true squared error as its mean.
double error_alone(const Image& image, const Image& first, const Image& second)
{
    double square = 0.0, sum = 0.0, count = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3 && !is_beside_lamp(first, x, y); ++c) {
                const double value = double(image.at(x, y)[c]);
                const double a = double(first.at(x, y)[c]), b = double(second.at(x, y)[c]);
                square += (value - a) * (value - b);
                sum += 0.5 * (a + b);
                ++count;
            }
    return std::sqrt(std::max(square, 0.0) / count) / (sum / count);
}

// Copper throws the lamp's light on the walls in spots, which shooters used to paint one by one.
TEST(Picture, OfBlocksOfMetalIsWhatPathsFind)
{
    RenderOptions options = small(8192);
    options.width = options.height = 48;
    const Image image = picture("glossy-cornell-box", options);
    const Image first = path_traced("glossy-cornell-box", options, 1024);
    options.bake.solver.method = GlossyOptions{.seed = 2};
    const Image second = path_traced("glossy-cornell-box", options, 1024);
    EXPECT_LE(error_alone(image, first, second), 0.06);
}

TEST(Picture, IsTheSameByShootersByRaysAndByBoth)
{
    RenderOptions options = small(4096);
    options.rays = 16;
    options.shots = 1024;
    const Image both = picture("glossy-floor", options);
    options.shots = 0;
    const Image rays = picture("glossy-floor", options);
    options.shots = 8192;
    options.rays = 0;
    const Image shooters = picture("glossy-floor", options);
    EXPECT_LE(std::abs(compare_maps(rays, both, kBelowLamps).bias), 0.01);
    // The disc of Eq. (8) bounds what shooters alone give.
    EXPECT_LE(std::abs(compare_maps(shooters, both, kBelowLamps).bias), 0.03);
}

/// Where no lamp is seen, no value is above 10 times the 99.9th percentile of what paths find.
void expect_no_fireflies(const Scene& scene)
{
    RenderOptions options = rough(1024);
    const Image image = render(scene, options).image;
    options.paths = 256;
    const Image truth = render(scene, options).image;
    const auto shows_lamp = [&](std::size_t i) { return truth.values[i] > kBelowLamps; };
    std::vector<float> values;
    for (std::size_t i = 0; i < truth.values.size(); ++i)
        if (!shows_lamp(i) && i % 4 != 3)
            values.push_back(truth.values[i]);
    const auto high = values.begin() + std::ptrdiff_t(0.999 * double(values.size()));
    std::nth_element(values.begin(), high, values.end());
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(image.values[i]));
        EXPECT_GE(image.values[i], 0.0f);
        if (!shows_lamp(i)) {
            EXPECT_LE(image.values[i], 10.0f * *high);
        }
    }
}

class PictureOfRoughness : public testing::TestWithParam<float> {};

TEST_P(PictureOfRoughness, HasNoFireflies)
{
    Scene scene = glossy_scene("glossy-floor");
    for (Material& material : scene.materials) {
        material.roughness = GetParam();
        material.metallic = 0.7f;
    }
    expect_no_fireflies(scene);
}

TEST_P(PictureOfRoughness, OfBlocksHasNoFireflies)
{
    Scene scene = glossy_scene("glossy-cornell-box");
    for (Material& material : scene.materials)
        if (material.metallic > 0.0f)
            material.roughness = GetParam();
    expect_no_fireflies(scene);
}

// Shininess 1, 7.3, 61 and 1000.
INSTANTIATE_TEST_SUITE_P(Roughnesses, PictureOfRoughness, testing::Values(1.0f, 0.5f, 0.3f, 0.1f));

TEST(Picture, OfTheSameSeedHasTheSameBytes)
{
    const RenderOptions options = rough(256);
    EXPECT_EQ(picture("specular-objects", options).values,
              picture("specular-objects", options).values);
}

TEST(Picture, HasSquarePixelsWhateverTheShapeOfTheCamera)
{
    for (const float aspect : {1e-30f, 5.0f, 1e30f}) {
        Scene scene = glossy_scene("glossy-floor");
        scene.cameras.at(0).aspect = aspect;
        RenderOptions options = small(1);
        options.width = 8;
        options.height = 0;
        options.paths = 1;
        const Image shaped = render(scene, options).image;
        options.height = shaped.height;
        EXPECT_EQ(render(scene, options).image.values, shaped.values) << aspect;
    }
}

TEST(Picture, OfAnOrthographicCameraShowsNearAndFarInOneSize)
{
    // Squares of 1 m, 1 m and 5 m away, side by side in a view of 4 x 2 m.
    Scene scene;
    scene.model = MaterialModel::glossy;
    const glm::vec3 emission(1.0f, 2.0f, 3.0f);
    support::add_quad(scene, {.corner = {-1.5f, -0.5f, -1.0f}, .emission = emission});
    support::add_quad(scene, {.corner = {0.5f, -0.5f, -5.0f}, .emission = emission});
    scene.cameras = {{.aspect = 2.0f, .orthographic_height = 2.0f}};
    RenderOptions options = small(64);
    options.width = 32;
    options.height = 0;
    const Image image = render(scene, options).image;
    ASSERT_EQ(image.height, 16);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool there = y >= 4 && y < 12 && x % 16 >= 4 && x % 16 < 12;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(image.at(x, y)[c], there ? emission[c] / support::kPi : 0.0f, 1e-4f);
            EXPECT_NEAR(image.at(x, y)[3], there ? 1.0f : 0.0f, 1e-5f);
        }
}

/// A camera at `eye` that looks along `back` times -1, in parallel.
Camera parallel_camera(const glm::vec3& eye, const glm::vec3& back, const glm::vec3& up)
{
    return {.transform = {glm::vec4(glm::cross(up, back), 0.0f), glm::vec4(up, 0.0f),
                          glm::vec4(back, 0.0f), glm::vec4(eye, 1.0f)},
            .orthographic_height = 0.5f};
}

class PictureOfASheet : public testing::TestWithParam<bool> {};

TEST_P(PictureOfASheet, LitFromAboveIsDarkFromBelow)
{
    const glm::vec3 x(1.0f, 0.0f, 0.0f), z(0.0f, 0.0f, 1.0f);
    Scene scene;
    scene.model = MaterialModel::glossy;
    support::add_quad(scene, {.corner = {-0.5f, 1.0f, -0.5f},
                              .edge_u = GetParam() ? z : x,
                              .edge_v = GetParam() ? x : z,
                              .double_sided = true});
    support::add_quad(
        scene,
        {.corner = {-0.5f, 2.0f, -0.5f}, .edge_u = x, .edge_v = z, .emission = glm::vec3(10.0f)});
    for (Material& material : scene.materials)
        material.metallic = 0.0f;
    RenderOptions options = rough(256);
    options.width = options.height = 16;
    options.shots = 0;
    scene.cameras = {parallel_camera({0.0f, 1.5f, 0.0f}, {0.0f, 1.0f, 0.0f}, -z)};
    const glm::dvec4 above = mean(render(scene, options).image);
    scene.cameras = {parallel_camera({0.0f, 0.5f, 0.0f}, {0.0f, -1.0f, 0.0f}, z)};
    const glm::dvec4 below = mean(render(scene, options).image);
    EXPECT_GT(above.r, 0.1);
    EXPECT_EQ(below, glm::dvec4(0.0, 0.0, 0.0, 1.0));
}

INSTANTIATE_TEST_SUITE_P(FrontUp, PictureOfASheet, testing::Bool());

TEST(Picture, OfOnePixelIsTheMeanOfMany)
{
    RenderOptions options = rough(1024);
    options.width = options.height = 32;
    const glm::dvec4 many = mean(picture("glossy-floor", options));
    options.width = options.height = 1;
    options.sets = 64;
    const glm::dvec4 one = mean(picture("glossy-floor", options));
    EXPECT_EQ(one.a, 1.0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(one[c], many[c], 0.1 * many[c]);
}

TEST(Picture, OfNothingIsEmpty)
{
    Scene scene = glossy_scene("glossy-floor");
    scene.cameras = {{.transform = {{1.0f, 0.0f, 0.0f, 0.0f},
                                    {0.0f, 1.0f, 0.0f, 0.0f},
                                    {0.0f, 0.0f, 1.0f, 0.0f},
                                    {0.0f, 0.0f, -1.0f, 1.0f}}}};
    for (const float value : render(scene, small(64)).image.values)
        ASSERT_EQ(value, 0.0f);
}

TEST(Picture, OfASceneWithoutLightIsBlack)
{
    Scene scene = glossy_scene("glossy-floor");
    for (Material& material : scene.materials)
        material.emitted = glm::vec3(0.0f);
    RenderOptions options = small(0);
    options.bake.solver.target_error = 0.02;
    const Image image = render(scene, options).image;
    for (std::size_t i = 0; i < image.values.size(); ++i)
        ASSERT_EQ(image.values[i], i % 4 == 3 ? 1.0f : 0.0f);
}

class PictureStoppedWhile : public testing::TestWithParam<const char*> {};

TEST_P(PictureStoppedWhile, IsWholeAndSaysSo)
{
    RenderOptions options = rough(256);
    options.shots = 256;
    if (GetParam() == std::string("path tracing"))
        options.paths = 64;
    bool met = false;
    const Rendered rendered =
        render(glossy_scene("glossy-floor"), options, [&](const BakeProgress& progress) {
            met |= progress.stage == GetParam();
            return progress.stage != GetParam();
        });
    EXPECT_TRUE(met);
    EXPECT_TRUE(rendered.summary.interrupted);
    for (std::size_t i = 0; i < rendered.image.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(rendered.image.values[i]));
        if (i % 4 == 3) {
            ASSERT_EQ(rendered.image.values[i], 1.0f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stages, PictureStoppedWhile,
                         testing::Values("looking", "shooting for the eye", "lobe rays",
                                         "path tracing"));

TEST(Picture, StoppedBeforeThereIsLightIsNone)
{
    for (const std::string stage : {"charts", "solving"}) {
        try {
            render(glossy_scene("glossy-floor"), small(512),
                   [&](const BakeProgress& progress) { return progress.stage != stage; });
            FAIL() << stage;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::stopped);
        }
    }
}

TEST(Picture, OfFewerRaysThanAskedForIsAsBright)
{
    RenderOptions options = rough(512);
    options.shots = 0;
    const Image whole = picture("glossy-floor", options);
    const auto stop = [](const BakeProgress& progress) { return progress.stage != "lobe rays"; };
    const Image stopped = render(glossy_scene("glossy-floor"), options, stop).image;
    // Seeds 1 to 5 gave 0.04 to 0.2 %.
    EXPECT_NE(stopped.values, whole.values);
    EXPECT_LE(std::abs(compare_maps(stopped, whole, kBelowLamps).bias), 0.01);
}

}  // namespace
}  // namespace lumel
