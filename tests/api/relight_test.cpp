// Baked scenes under other light.

#include <cmath>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "boxes.h"

namespace lumel::v0 {
namespace {

using test::expect_error;
using test::scene_path;

constexpr double kMatrixError = 3e-3;  // of the compressed matrix, which aims at 0.2 %
constexpr double kPapersError = 0.03;  // of its form of the matrix, which "hardly differs" [SF17]
constexpr double kStateRounding = 1e-6;

/// A bake whose light can be changed. Made once: it takes long.
struct Relightables : testing::Test {
    static Baked made()
    {
        Scene scene = Scene::load(scene_path("cornell-box"));
        scene.add_daylight({.sky_luminance = Vec3{1.0f, 2.0f, 4.0f},
                            .sun = Daylight::Sun{.azimuth = 0.1, .elevation = 0.4}});
        return bake(Device(), scene, {.atlas = {.size = 16}, .method = "matrix"});
    }
    /// As the paper stores the matrix.
    static Baked in_papers_form()
    {
        return bake(Device(), Scene::load(scene_path("cornell-box")),
                    {.atlas = {.size = 16},
                     .method = "matrix",
                     .options = {{"patches", "150"}, {"form", "bc1"}}});
    }
    static const Baked& baked()
    {
        static const Baked instance = made();
        return instance;
    }
};

/// That the RMS difference from factor × `wanted` is less than so much of its mean.
void expect_alike(const Map& map, const Map& wanted, float factor, double tolerance)
{
    ASSERT_EQ(map.rgba.size(), wanted.rgba.size());
    double square = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < map.rgba.size(); ++i)
        if (i % 4 < 3) {
            const double value = double(factor * wanted.rgba[i]);
            square += (double(map.rgba[i]) - value) * (double(map.rgba[i]) - value);
            sum += value;
            count += 1.0;
        }
    EXPECT_LT(std::sqrt(square / count), tolerance * sum / count);
}

TEST_F(Relightables, AreWhatWasBakedUntilTheirLightChanges)
{
    const Device device;
    Relight relight(device, baked());
    const Map map = relight.map();
    expect_alike(map, baked().map, 1.0f, kMatrixError);
    for (const std::string& name : relight.lights())
        relight.set_light(name, {0.5f, 0.5f, 0.5f});
    expect_alike(relight.map(), map, 0.5f, kStateRounding);
}

TEST_F(Relightables, MoveTheirSunAndItsLightComesBack)
{
    const Device device;
    Relight relight(device, baked());
    const Map map = relight.map();
    relight.move_light("sun", {.direction = Vec3{0.3f, -0.1f, 1.0f}});
    const Map moved = relight.map();
    double apart = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < map.rgba.size(); ++i) {
        apart += std::abs(double(moved.rgba[i] - map.rgba[i]));
        sum += double(map.rgba[i]);
    }
    EXPECT_GT(apart, 0.05 * sum);
    relight.move_light("sun", {});
    expect_alike(relight.map(), map, 1.0f, kStateRounding);
    expect_error(ErrorKind::input, {"sky", "lamp"}, [&] {
        relight.move_light("sky", {.position = Vec3{0, 0, 0}});
    });
}

TEST_F(Relightables, InThePapersFormComeBackFromTheirFileAsWell)
{
    const lumel::test::TemporaryFolder folder;
    const Device device;
    const Baked baked = in_papers_form();
    Relight relight(device, baked);
    relight.save(folder / "scene.lumelmat");
    Relight(device, folder / "scene.lumelmat").save(folder / "again.lumelmat");
    using lumel::test::bytes_of;
    EXPECT_EQ(bytes_of(folder / "again.lumelmat"), bytes_of(folder / "scene.lumelmat"));
    expect_alike(relight.map(), baked.map, 1.0f, kPapersError);
}

TEST_F(Relightables, ComeBackFromTheirFile)
{
    const lumel::test::TemporaryFolder folder;
    const Device device;
    const Relight relight(device, baked());
    relight.save(folder / "scene.lumelmat");
    Relight again(device, folder / "scene.lumelmat");
    EXPECT_EQ(again.lights(), relight.lights());
    const Map map = again.map();
    EXPECT_EQ(map.width, baked().map.width);
    expect_error(ErrorKind::output, {"nosuch"},
                 [&] { relight.save(folder / "nosuch/scene.lumelmat"); });
    expect_error(ErrorKind::input, {"nosuch"}, [&] { Relight(device, folder / "nosuch"); });
}

TEST_F(Relightables, NameTheirLightsWhereOneIsUnknown)
{
    const Device device;
    Relight relight(device, baked());
    expect_error(ErrorKind::input, {"no such light", "sky"}, [&] {
        relight.set_light("no such light", {1, 1, 1});
    });
    expect_error(ErrorKind::input, {"sky"}, [&] { relight.set_light("sky", {-1, 1, 1}); });
    expect_error(ErrorKind::input, {"relightable"}, [&] { Relight(device, Baked{}); });
}

}  // namespace
}  // namespace lumel::v0
