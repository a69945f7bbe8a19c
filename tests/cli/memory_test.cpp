// Memory is planned before the work, and kept to.

#include <regex>

#include <gtest/gtest.h>

#include "program.h"
#include "json/json_file.h"

namespace lumel::test {
namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;

TEST(MaxMemory, WhatDoesNotFitIsRefusedWithASizeThatDoes)
{
    const Workplace place;
    const auto bake = [&](const std::string& size) {
        return run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"), "--size", size,
                          "--shots", "24", "--max-memory", "400M"});
    };
    const Outcome refused = bake("512");
    expect_one_sentence(refused, 3, {"512 × 512", "--max-memory allows 400.0 MiB", "--size"});
    EXPECT_FALSE(std::filesystem::exists(place.path("out/report.json")));
    std::smatch size;
    ASSERT_TRUE(std::regex_search(refused.err, size, std::regex("--size ([0-9]+)")));
    EXPECT_GE(std::stoi(size[1]), 64);
    const Outcome done = bake(size[1]);
    ASSERT_EQ(done.code, 0) << done.err;
    const Json report = read_json(place.path("out/report.json"));
    EXPECT_LE(report["memory"]["peak_host_bytes"].get<double>(), 400.0 * kMebibyte);
}

TEST(MaxMemory, OfTheHostIsAsDescribed)
{
    constexpr double kAlike = 0.25;
    const Workplace place;
    const std::vector<std::string> what = {own_scene("cornell-box.gltf"), "--size", "512"};
    std::vector<std::string> info = {"info"}, bake = {"bake"};
    info.insert(info.end(), what.begin(), what.end());
    info.emplace_back("--json");
    bake.insert(bake.end(), what.begin(), what.end());
    bake.insert(bake.begin() + 2, place.path("out"));
    bake.insert(bake.end(), {"--shots", "24", "--preview-width", "0"});
    const Json said = Json::parse(run_lumel(info).out);
    ASSERT_EQ(run_lumel(bake).code, 0);
    const Json report = read_json(place.path("out/report.json"));
    const auto peak = report["memory"]["peak_host_bytes"].get<double>();
    EXPECT_NEAR(said["host_memory_bytes"].get<double>(), peak, kAlike * peak)
        << said["host_memory_parts"];
}

TEST(MaxMemory, LinksStopAddingRaysBeforeTheyTakeMore)
{
    const Workplace place;
    const Outcome done = run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"),
                                    "--size", "128", "--error", "0.3", "--time", "60",
                                    "--preview-width", "0", "--max-memory", "390M"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_NE(done.err.find("no memory for more rays"), std::string::npos) << done.err;
    const Json report = read_json(place.path("out/report.json"));
    EXPECT_NE(report["warnings"].dump().find("--max-memory"), std::string::npos);
    EXPECT_GE(report["solution"]["shots"].get<double>(), 24.0);
    EXPECT_LT(report["solution"]["shots"].get<double>(), 250.0);
}

TEST(MaxMemory, ASizeThatIsNoneIsRefused)
{
    const Workplace place;
    for (const char* size : {"", "2", "G", "-1G", "1e400G", "1e30G", "nanG", "2 G", "2T"})
        expect_one_sentence(run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"),
                                       "--max-memory", size}),
                            2, {"--max-memory"});
}

}  // namespace
}  // namespace lumel::test
