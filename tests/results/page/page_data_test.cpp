// Data of a page, from a small folder written by hand.

#include <filesystem>

#include <gtest/gtest.h>

#include "../../scene/gltf_builder.h"
#include "../../support/input_error.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "results/page/page.h"

namespace lumel::test {
namespace {

constexpr int kSide = 8;

Image lit(float light, int side = kSide)
{
    Image map(side, side, 4);
    map.values.assign(map.values.size(), light);
    return map;
}

void write_map(const TempFolder& folder, const std::string& name, const Image& map)
{
    write_exr(folder.path(name), map, Precision::float32, {});
}

/// The files of a bake that a page reads.
void write_bake(const TempFolder& folder)
{
    GltfBuilder builder;
    builder.show(
        {{"attributes", {{"POSITION", builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}}});
    builder.write(folder);
    write_json(folder.path("report.json"), {{"sizes", {{"atlas_width", kSide}}}});
    write_map(folder, "lightmap.exr", lit(3.0f));
    write_map(folder, "solution.exr", lit(3.0f));
}

void write_lamps(const TempFolder& folder, const std::vector<std::string>& names)
{
    Json list = Json::array();
    for (const std::string& name : names)
        list.push_back({{"name", name},
                        {"kind", "point"},
                        {"members", {name}},
                        {"unit", "lx"},
                        {"color", {1, 1, 1}},
                        {"map", name + ".exr"}});
    write_json(folder.path("lamps.json"), {{"lamps", list}, {"sum_error", 0.0}});
}

TEST(PageData, IsAsBeforeForABakeWithoutLamps)
{
    const TempFolder folder;
    write_bake(folder);
    const Json data = page_data(folder.path(""), "bake");
    std::vector<std::string> members;
    for (const auto& [name, value] : data.items())
        members.push_back(name);
    EXPECT_EQ(members, (std::vector<std::string>{"name", "report", "pages_across", "glb",
                                                 "lightmap", "unit", "errors", "least_error"}));
}

TEST(PageData, HoldsTheLampsOfABake)
{
    const TempFolder folder;
    write_bake(folder);
    write_lamps(folder, {"a", "b"});
    write_map(folder, "a.exr", lit(1.0f));
    write_map(folder, "b.exr", lit(2.0f));
    const Json lamps = page_data(folder.path(""), "bake")["lamps"];
    ASSERT_EQ(lamps["list"].size(), 2u);
    EXPECT_EQ(lamps["list"][0]["name"], "a");
    EXPECT_EQ(lamps["list"][1]["brightest"], 2.0);
    EXPECT_FALSE(lamps["maps"].get<std::string>().empty());
}

void write_daylight(const TempFolder& folder)
{
    const Json hour = {{"hour", "06-21T12"},
                       {"sun", {0, 1, 0}},
                       {"lux", 100.0},
                       {"mean", 5.0},
                       {"weights", {1, -1}}};
    Json maps = Json::array();
    for (const char* name : {"day-a.exr", "day-b.exr"})
        maps.push_back({{"hour", "06-21T12"}, {"unit", "lx"}, {"map", name}});
    write_json(folder.path("daylight.json"),
               {{"place", {{"name", "Made"}, {"latitude", 47}, {"longitude", 19}}},
                {"error", 0.01},
                {"maps", maps},
                {"hours", {hour}}});
    write_map(folder, "day-a.exr", lit(40.0f));
    write_map(folder, "day-b.exr", lit(20.0f));
}

TEST(PageData, AddsTheMeanOfDaylightToTheLightmap)
{
    const TempFolder folder;
    write_bake(folder);
    write_lamps(folder, {"a"});
    write_map(folder, "a.exr", lit(3.0f));
    write_daylight(folder);
    const Json data = page_data(folder.path(""), "bake");
    EXPECT_EQ(data["daylight"]["place"], "Made");
    EXPECT_EQ(data["daylight"]["maps"], 2);
    const Json& list = data["lamps"]["list"];
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[0]["name"], "a");
    EXPECT_EQ(list[0]["brightest"], 3.0);
    EXPECT_EQ(list[1]["kind"], "daylight");
    EXPECT_EQ(list[1]["brightest"], 20.0) << "half of the first of two maps";
    EXPECT_EQ(list[2]["brightest"], 10.0);
    // The brightest texel of the lightmap is 1000 units: 3 lx of the lamp, 20 and 10 of daylight.
    EXPECT_NEAR(data["unit"].get<double>(), 0.033, 1e-6);
}

TEST(PageData, MakesALampOfTheLightOfABakeWithDaylight)
{
    const TempFolder folder;
    write_bake(folder);
    write_daylight(folder);
    const Json lit_bake = page_data(folder.path(""), "bake")["lamps"]["list"];
    ASSERT_EQ(lit_bake.size(), 3u);
    EXPECT_EQ(lit_bake[0]["name"], "light of the bake");
    EXPECT_EQ(lit_bake[0]["brightest"], 3.0);
    write_map(folder, "lightmap.exr", lit(0.0f));
    EXPECT_EQ(page_data(folder.path(""), "bake")["lamps"]["list"].size(), 2u)
        << "a bake without light has no such lamp";
}

TEST(PageData, NamesAMapThatIsMissingOrOfAnotherSize)
{
    const TempFolder folder;
    write_bake(folder);
    write_lamps(folder, {"a"});
    const auto refusal = [&] {
        return test::input_error_of([&] { page_data(folder.path(""), "bake"); });
    };
    EXPECT_NE(refusal().find("a.exr"), std::string::npos) << refusal();
    write_map(folder, "a.exr", lit(1.0f, kSide / 2));
    EXPECT_NE(refusal().find("another size than the lightmap"), std::string::npos) << refusal();
    folder.write("lamps.json", std::string("{\"lamps\": [}"));
    EXPECT_NE(refusal().find("lamps.json: its JSON is broken at line 1"), std::string::npos)
        << refusal();
    std::filesystem::remove(folder.path("lamps.json"));
    write_daylight(folder);
    write_map(folder, "day-b.exr", lit(1.0f, kSide / 2));
    EXPECT_NE(refusal().find("day-b: has another size than the lightmap"), std::string::npos)
        << refusal();
}

}  // namespace
}  // namespace lumel::test
