// Pictures of glossy scenes, against path tracing.

#include "bake/render.h"

#include <algorithm>
#include <cmath>

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

TEST(Picture, OfARoomWithAPolishedFloorIsWhatPathsFind)
{
    const RenderOptions options = small(8192);
    const MapError error = compare_maps(picture("glossy-floor", options),
                                        path_traced("glossy-floor", options, 4096), kBelowLamps);
    // Seeds 1 to 3 gave 4.2 to 5.8 %, and -0.7 to -1.6 %: lobes between close lumels.
    EXPECT_LE(error.relative_rmse, 0.07);
    EXPECT_LE(std::abs(error.bias), 0.02);
}

TEST(Picture, IsTheSameByShootersByRaysAndByBoth)
{
    RenderOptions options = small(4096);
    options.rays = 64;
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

class PictureOfRoughness : public testing::TestWithParam<float> {};

TEST_P(PictureOfRoughness, HasNoFireflies)
{
    Scene scene = glossy_scene("glossy-floor");
    for (Material& material : scene.materials) {
        material.roughness = GetParam();
        material.metallic = 0.7f;
    }
    RenderOptions options = small(2048);
    const Image image = render(scene, options).image;
    options.paths = 256;
    const Image truth = render(scene, options).image;
    std::vector<float> values(truth.values);
    const auto high = values.begin() + std::ptrdiff_t(0.999 * double(values.size()));
    std::nth_element(values.begin(), high, values.end());
    for (const float value : image.values) {
        EXPECT_TRUE(std::isfinite(value));
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 10.0f * *high);
    }
}

// Shininess 1, 7.3, 61 and 1000.
INSTANTIATE_TEST_SUITE_P(Roughnesses, PictureOfRoughness, testing::Values(1.0f, 0.5f, 0.3f, 0.1f));

TEST(Picture, OfTheSameSeedHasTheSameBytes)
{
    const RenderOptions options = small(512);
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

}  // namespace
}  // namespace lumel
