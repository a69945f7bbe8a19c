#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "output/report.h"

namespace lumel {
namespace {

TEST(Report, SaysWhatItWasGiven)
{
    Report report;
    report.scene = "room.glb";
    report.seed = 7;
    report.settings = {{"error", "0.02"}, {"batch", "16"}};
    report.convergence = {{100, 0.5, 0.1}, {200, 1.0, 0.05}};
    report.gpu_milliseconds = {{"receive", {1.0, 3.0}}, {"never run", {}}};
    report.warnings = {"a lamp is too bright"};
    const auto json = nlohmann::json::parse(to_json(report));
    EXPECT_EQ(json["scene"]["file"], "room.glb");
    EXPECT_EQ(json["settings"]["error"], "0.02");
    EXPECT_EQ(json["solution"]["seed"], 7);
    EXPECT_EQ(json["solution"]["convergence"][1]["shots"], 200);
    EXPECT_EQ(json["timings"]["gpu"]["receive"]["total_ms"], 4.0);
    EXPECT_FALSE(json["timings"]["gpu"].contains("never run"));
    EXPECT_EQ(json["warnings"][0], "a lamp is too bright");
}

TEST(Report, NamesTheUnitsOfEveryMap)
{
    const auto json = nlohmann::json::parse(to_json(Report{}));
    EXPECT_EQ(json["units"]["irradiance"], "lx");
    for (const char* file : {"lightmap.exr", "lightmap.png", "scene.glb", "scene-baked.glb"})
        EXPECT_TRUE(json["units"].contains(file)) << file;
}

TEST(Report, LeavesOutWhatIsNotKnown)
{
    const auto json = nlohmann::json::parse(to_json(Report{}));
    EXPECT_FALSE(json["solution"].contains("estimated_error"));
    EXPECT_TRUE(json["memory"].empty());
    EXPECT_TRUE(json["device"].empty());
}

TEST(Report, IsJsonWhateverItIsGiven)
{
    Report report;
    report.scene = "broken \xFF name\n\"";
    report.wall_seconds = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(nlohmann::json::accept(to_json(report)));
}

TEST(Report, TheSameReportGivesTheSameText)
{
    Report report;
    report.settings = {{"z", "1"}, {"a", "2"}};
    EXPECT_EQ(to_json(report), to_json(report));
    EXPECT_LT(to_json(report).find("\"z\""), to_json(report).find("\"a\""));
}

}  // namespace
}  // namespace lumel
