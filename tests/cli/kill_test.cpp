// A bake that is killed at any moment costs no result.

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;

/// LUMEL_KILLS: how often each test kills.
int kills()
{
    const char* given = std::getenv("LUMEL_KILLS");
    return given ? std::atoi(given) : 5;
}

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// All files of a folder by name; of the report, in which times differ, only the seed.
std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (name.starts_with(".lumel-"))
            continue;
        std::string& bytes = all[name] = bytes_of(entry.path().string());
        if (name == "report.json")
            bytes = nlohmann::json::parse(bytes)["settings"]["seed"].dump();
    }
    return all;
}

std::vector<std::string> hidden(const fs::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("."))
            names.push_back(entry.path().filename().string());
    return names;
}

TEST(Kills, AtAnyMomentLeaveAllOldOrAllNewAndNothingForTheNextRun)
{
    const Workplace place;
    const auto bake = [&](int seed, double kill_after) {
        return run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"), "--size", "16",
                          "--shots", "24", "--preview-width", "32", "--seed", std::to_string(seed)},
                         {.kill_after = kill_after});
    };
    ASSERT_EQ(bake(1, 0.0).code, 0);
    fs::create_directory(place.path("out/mine"));
    place.file("out/mine/notes.txt", "mine");
    const auto old = contents(place.path("out"));
    double whole = 0.0;
    whole = seconds_of([&] { ASSERT_EQ(bake(2, 0.0).code, 0); });
    const auto fresh = contents(place.path("out"));
    ASSERT_NE(old, fresh);
    ASSERT_EQ(bake(1, 0.0).code, 0);
    ASSERT_EQ(contents(place.path("out")), old);

    // Half of the moments are in the last tenth, where files are written and moved.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0.001, whole), late(0.9 * whole, 1.05 * whole);
    int kept = 0, replaced = 0, mixed = 0, left_over = 0, ended = 0;
    for (int k = 0; k < kills(); ++k) {
        const double moment = k % 2 ? late(random) : any(random);
        ended += bake(2, moment).code == 0;
        const auto found = contents(place.path("out"));
        ++(found == old ? kept : found == fresh ? replaced : mixed);
        ASSERT_EQ(bake(1, 0.0).code, 0);
        left_over += !hidden(place.path("out")).empty() || contents(place.path("out")) != old;
    }
    std::cout << kills() << " kills: old " << kept << ", new " << replaced << " (too late " << ended
              << "), mixed " << mixed << ", left over after the next run " << left_over << '\n';
    EXPECT_EQ(mixed, 0);
    EXPECT_EQ(left_over, 0);
}

}  // namespace
}  // namespace lumel::test
