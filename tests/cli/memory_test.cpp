// Memory is planned before the work, and kept to.

#include <regex>

#include <gtest/gtest.h>

#include "base/json/json_file.h"
#include "program.h"

namespace lumel::test {
namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;

TEST(MaxMemory, WhatDoesNotFitIsRefusedWithASizeThatDoes)
{
    const Workplace place;
    // The worst case: Mesa has compiled nothing yet.
    const auto bake = [&](const std::string& size) {
        return run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"), "--size", size,
                          "--shots", "24", "--max-memory", "400M"},
                         {.environment = {"MESA_SHADER_CACHE_DIR=" + place.path("shaders")}});
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

/// What lumel info states of a bake is what the system then sees.
void expect_as_stated(const std::string& scene, const std::vector<std::string>& options)
{
    constexpr double kMin = 0.85, kMax = 1.3;  // of the peak
    const Workplace place;
    std::vector<std::string> info = {"info", own_scene(scene), "--json"},
                             bake = {"bake", own_scene(scene), place.path("out")};
    for (std::vector<std::string>* command : {&info, &bake})
        command->insert(command->end(), options.begin(), options.end());
    bake.insert(bake.end(), {"--error", "5"});
    const Json said = Json::parse(run_lumel(info).out);
    const Outcome done = run_lumel(bake);
    ASSERT_EQ(done.code, 0) << done.err;
    const auto stated = said["host_memory_bytes"].get<double>(), peak = double(done.peak_bytes);
    EXPECT_GE(stated, kMin * peak) << scene << ", stated: " << said["host_memory_parts"];
    EXPECT_LE(stated, kMax * peak) << scene << ", stated: " << said["host_memory_parts"];
}

TEST(MaxMemory, OfTheHostIsAsStatedWithAPreview)
{
    expect_as_stated("cornell-box.gltf", {"--size", "384"});
}

TEST(MaxMemory, OfTheHostIsAsStatedOnPagesUnderASky)
{
    expect_as_stated("city.gltf", {"--size", "192", "--pages", "4", "--sky", "overcast",
                                   "--preview-width", "0"});
}

TEST(MaxMemory, LinksStopAddingRaysBeforeTheyTakeMore)
{
    const Workplace place;
    const Outcome done = run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"),
                                    "--size", "192", "--error", "0.1", "--time", "60",
                                    "--preview-width", "0", "--max-memory", "131M"});
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
