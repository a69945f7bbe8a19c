// What a bake shows of itself: --verbose and --dump.

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/images/image_files.h"
#include "program.h"

namespace lumel::test {
namespace {

std::vector<std::string> bake_of_128_rays(const std::string& folder,
                                          const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {"bake", own_scene("cornell-box.gltf"),
                                          folder, "--size",
                                          "32",   "--shots",
                                          "128",  "--preview-width",
                                          "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Verbose, TellsStagesSizesMemoryAndDeviceTimesOnStderr)
{
    const Workplace place;
    const Outcome bake = run_lumel(
        bake_of_128_rays(place.path("out"), {"--solver", "stochastic", "--verbose", "--json"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    const auto report = nlohmann::json::parse(bake.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << bake.out;
    for (const auto& stage : report["timings"]["stages"]) {
        const std::string name = stage["stage"];
        EXPECT_TRUE(has(bake.err, "s  " + name + ": begins\n")) << name << "\n" << bake.err;
        EXPECT_TRUE(has(bake.err, "s  " + name + ": took ")) << name << "\n" << bake.err;
    }
    for (const std::string size : {"charts", "lumels"})
        EXPECT_TRUE(has(bake.err, report["sizes"][size].dump() + " " + size)) << bake.err;
    EXPECT_TRUE(has(bake.err, "close pairs take ")) << bake.err;
    EXPECT_TRUE(has(bake.err, "128 shooters in 8 steps")) << bake.err;
    EXPECT_TRUE(has(bake.err, "iB of raster/world/world.cpp:")) << bake.err;
    EXPECT_TRUE(has(bake.err, "solving: \"receive\" took ")) << bake.err;
    EXPECT_TRUE(has(bake.err, " MiB, device memory ")) << bake.err;
}

TEST(Verbose, ChangesNothingElse)
{
    const Workplace place;
    const Outcome plain = run_lumel(bake_of_128_rays(place.path("plain"), {}));
    const Outcome verbose = run_lumel(bake_of_128_rays(place.path("verbose"), {"--verbose"}));
    EXPECT_EQ(plain.err, "");
    EXPECT_EQ(std::ranges::count(verbose.out, '\n'), std::ranges::count(plain.out, '\n'))
        << verbose.out;
    EXPECT_EQ(bytes_of(place.path("plain/lightmap.exr")),
              bytes_of(place.path("verbose/lightmap.exr")));
}

TEST(Dump, ShowsWhatTheBakeWorkedWith)
{
    const Workplace place;
    const Outcome bake =
        run_lumel(bake_of_128_rays(place.path("out"), {"--solver", "stochastic", "--hemicube", "64",
                                                       "--dump", place.path("inside")}));
    ASSERT_EQ(bake.code, 0) << bake.err;

    // The lamp at 0.5483 m looks down on two blocks, the taller 0.33 m high; walls hide nothing.
    const Image hemicube = read_exr(place.path("inside/hemicube.exr"));
    ASSERT_EQ(hemicube.width, 128);
    ASSERT_EQ(hemicube.height, 96);
    float nearest = std::numeric_limits<float>::infinity();
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (const float distance = *hemicube.at(x, y); distance > 0.0f)
                nearest = std::min(nearest, distance);
    EXPECT_NEAR(nearest, 0.2183f, 0.001f);
    EXPECT_EQ(*hemicube.at(63, 0), 0.0f);

    const Image lightmap = read_exr(place.path("out/lightmap.exr"));
    const Image near = read_exr(place.path("inside/near.exr"));
    const Image power = read_exr(place.path("inside/power.exr"));
    ASSERT_EQ(near.values.size(), lightmap.values.size());
    ASSERT_EQ(power.values.size(), lightmap.values.size());
    float most_near = 0.0f;
    for (std::size_t i = 0; i < lightmap.values.size(); i += 4) {
        EXPECT_EQ(near.values[i + 3], lightmap.values[i + 3]);  // coverage
        EXPECT_EQ(power.values[i + 3], lightmap.values[i + 3]);
        EXPECT_GE(power.values[i], 0.0f);
        most_near = std::max(most_near, near.values[i]);
    }
    EXPECT_GT(most_near, 0.1f);      // in the box's edges
    EXPECT_LE(most_near, 1.00001f);  // sums of floats

    for (const std::string name : {"hemicube", "illumination-1", "illumination-2", "near", "power"})
        EXPECT_EQ(bytes_of(place.path("inside/" + name + ".png")).substr(1, 3), "PNG") << name;
}

TEST(Dump, IsThereForPicturesToo)
{
    const Workplace place;
    const Outcome render =
        run_lumel({"render", own_scene("glossy-cornell-box.gltf"), place.path("a.png"), "--size",
                   "32", "--width", "32", "--shots", "64", "--eye-shots", "64", "--projection",
                   "hemisphere", "--hemicube", "32", "--dump", place.path("inside")});
    ASSERT_EQ(render.code, 0) << render.err;
    EXPECT_EQ(read_exr(place.path("inside/hemisphere.exr")).width, 64);
    EXPECT_EQ(read_exr(place.path("inside/power.exr")).width, 32);
}

}  // namespace
}  // namespace lumel::test
