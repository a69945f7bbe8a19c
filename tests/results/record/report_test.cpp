#include <limits>

#include "base/json/json_file.h"
#include "results/record/report.h"
#include <gtest/gtest.h>

namespace lumel {
namespace {

TEST(Report, SaysWhatItWasGiven)
{
    Report report;
    report.scene = "room.glb";
    report.settings = {{"gutter", 2}, {"half", true}};
    report.solver = {{"method", "gather"}, {"options", {{"seed", 7}}}};
    report.convergence = {{100, 0.5, 0.1}, {200, 1.0, 0.05}};
    report.gpu_milliseconds = {{"receive", {1.0, 3.0}}, {"never run", {}}};
    report.warnings = {"a lamp is too bright"};
    const Json json = to_json(report);
    EXPECT_EQ(json["scene"]["file"], "room.glb");
    EXPECT_EQ(json["settings"]["gutter"], 2);
    EXPECT_EQ(json["settings"]["half"], true);
    EXPECT_EQ(json["solver"]["options"]["seed"], 7);
    EXPECT_EQ(json["solution"]["convergence"][1]["shots"], 200);
    EXPECT_EQ(json["timings"]["gpu"]["receive"]["total_ms"], 4.0);
    EXPECT_FALSE(json["timings"]["gpu"].contains("never run"));
    EXPECT_EQ(json["warnings"][0], "a lamp is too bright");
}

TEST(Report, NamesTheUnitsOfEveryMap)
{
    const Json json = to_json(Report{});
    EXPECT_EQ(json["units"]["irradiance"], "lx");
    for (const char* file : {"lightmap.exr", "lightmap.png", "scene.glb", "scene-baked.glb"})
        EXPECT_TRUE(json["units"].contains(file)) << file;
}

TEST(Report, LeavesOutWhatIsNotKnown)
{
    const Json json = to_json(Report{});
    EXPECT_FALSE(json["solution"].contains("estimated_error"));
    EXPECT_TRUE(json["memory"].empty());
    EXPECT_TRUE(json["device"].empty());
}

TEST(Report, IsJsonWhateverItIsGiven)
{
    Report report;
    report.scene = "broken \xFF name\n\"";
    report.wall_seconds = std::numeric_limits<double>::infinity();
    const std::string text = json_text(to_json(report));
    EXPECT_TRUE(Json::accept(text)) << text;
    EXPECT_TRUE(Json::parse(text)["timings"]["wall_seconds"].is_null());
}

TEST(Report, TheSameReportGivesTheSameText)
{
    Report report;
    report.settings = {{"z", 1}, {"a", 2}};
    const std::string text = json_text(to_json(report));
    EXPECT_EQ(json_text(to_json(report)), text);
    EXPECT_LT(text.find("\"z\""), text.find("\"a\""));
}

}  // namespace
}  // namespace lumel
