// A bake that is killed at any moment costs no result.

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <stdexcept>

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

/// A seed that differs from run to run, and is printed: LUMEL_KILL_SEED repeats a run.
unsigned fresh_seed()
{
    const char* given = std::getenv("LUMEL_KILL_SEED");
    const unsigned seed = given ? unsigned(std::atoll(given)) : std::random_device{}();
    std::cout << "LUMEL_KILL_SEED=" << seed << '\n';
    return seed;
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
                          "--shots", "24", "--preview-width", "32", "--probes", "0.1", "--seed",
                          std::to_string(seed)},
                         {.kill_after = kill_after});
    };
    ASSERT_EQ(bake(1, 0.0).code, 0);
    place.file("out/notes.txt", "mine");
    const auto old = contents(place.path("out"));
    double whole = 0.0;
    whole = seconds_of([&] { ASSERT_EQ(bake(2, 0.0).code, 0); });
    const auto fresh = contents(place.path("out"));
    ASSERT_NE(old, fresh);
    ASSERT_EQ(bake(1, 0.0).code, 0);
    ASSERT_EQ(contents(place.path("out")), old);

    // Half of the moments are in the last tenth, where files are written and moved.
    std::mt19937 random(fresh_seed());
    std::uniform_real_distribution<double> any(0.001, whole), late(0.9 * whole, 1.05 * whole);
    int kept = 0, replaced = 0, mixed = 0, left_over = 0, ended = 0;
    for (int k = 0; k < kills(); ++k) {
        const double moment = k % 2 ? late(random) : any(random);
        ended += bake(2, moment).code == 0;
        const auto found = contents(place.path("out"));
        ++(found == old ? kept : found == fresh ? replaced : mixed);
        ASSERT_EQ(bake(1, 0.0).code, 0);
        left_over += !hidden(place.path("out")).empty() || contents(place.path("out")) != old;
        if (mixed > 0 || left_over > 0)
            break;
    }
    std::cout << kills() << " kills: old " << kept << ", new " << replaced << " (too late " << ended
              << "), mixed " << mixed << ", left over after the next run " << left_over << '\n';
    EXPECT_LT(ended, kills());
    EXPECT_EQ(mixed, 0);
    EXPECT_EQ(left_over, 0);
}

struct Job {
    std::string error = "0.7", checkpoint = "0.01";
    std::vector<std::string> more{};
};

/// A bake of a few seconds, whose state is written all the time.
std::vector<std::string> resumable(const std::string& folder, const Job& job = {})
{
    std::vector<std::string> arguments = {"bake",        own_scene("cornell-box.gltf"),
                                          folder,        "--size",
                                          "48",          "--preview-width",
                                          "32",          "--error",
                                          job.error,     "--checkpoint",
                                          job.checkpoint};
    arguments.insert(arguments.end(), job.more.begin(), job.more.end());
    return arguments;
}

TEST(Kills, AreGoneOnFromToTheSameBytes)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(resumable(place.path("whole"), {.checkpoint = "0"})).code, 0);
    double seconds = 0.0;
    seconds = seconds_of([&] { ASSERT_EQ(run_lumel(resumable(place.path("out"))).code, 0); });
    const auto whole = contents(place.path("whole"));
    std::mt19937 random(fresh_seed());
    std::uniform_real_distribution<double> moment(0.0, seconds);
    const int most = 20 * kills();
    int same = 0, went_on = 0;
    for (int tries = 0; went_on < kills() && tries < most; ++tries) {
        fs::remove_all(place.path("out"));
        // The first is killed, what goes on is killed again, and then it ends.
        run_lumel(resumable(place.path("out")), {.kill_after = moment(random)});
        run_lumel(resumable(place.path("out"), {.more = {"--resume"}}),
                  {.kill_after = moment(random)});
        if (!fs::exists(place.path("out/.lumel-checkpoint")))
            continue;
        const Outcome last = run_lumel(resumable(place.path("out"), {.more = {"--resume"}}));
        ASSERT_EQ(last.code, 0) << last.err;
        EXPECT_NE(last.err.find("continuing after"), std::string::npos) << last.err;
        ++went_on;
        same += contents(place.path("out")) == whole && hidden(place.path("out")).empty();
    }
    std::cout << went_on << " bakes killed twice and gone on with: the same bytes " << same << '\n';
    EXPECT_EQ(went_on, kills());
    EXPECT_EQ(same, kills());
}

/// The light of lamps kept apart is part of the checkpoint.
TEST(Resume, OfABakePerLampGivesTheSameMaps)
{
    const Workplace place;
    const std::vector<std::string> lamps = {"--per-lamp", "--sky", "1,2,3"};
    ASSERT_EQ(run_lumel(resumable(place.path("whole"), {.checkpoint = "0", .more = lamps})).code,
              0);
    const auto whole = contents(place.path("whole"));
    ASSERT_TRUE(whole.contains("lamp-sky.exr"));
    bool went_on = false;
    for (double seconds = 0.5; !went_on && seconds < 60.0; seconds *= 1.2) {
        fs::remove_all(place.path("out"));
        run_lumel(resumable(place.path("out"), {.more = lamps}), {.kill_after = seconds});
        if (!fs::exists(place.path("out/.lumel-checkpoint")))
            continue;
        std::vector<std::string> more = lamps;
        more.emplace_back("--resume");
        const Outcome last = run_lumel(resumable(place.path("out"), {.more = more}));
        ASSERT_EQ(last.code, 0) << last.err;
        went_on = last.err.find("continuing after") != std::string::npos;
    }
    EXPECT_TRUE(went_on);
    EXPECT_TRUE(contents(place.path("out")) == whole);
}

/// A folder in which a bake has left its checkpoint. Returns after how long it was killed [s].
double leave_checkpoint(const std::string& folder)
{
    double seconds = 0.5;
    for (; !fs::exists(folder + "/.lumel-checkpoint"); seconds *= 1.2) {
        fs::remove_all(folder);
        if (seconds > 60.0)
            throw std::runtime_error("no checkpoint appears");
        run_lumel(resumable(folder, {.error = "0.001"}), {.kill_after = seconds});
    }
    return seconds;
}

TEST(Resume, RefusesACheckpointOfOtherWorkOrADamagedOne)
{
    const Workplace place;
    leave_checkpoint(place.path("out"));
    const std::string checkpoint = bytes_of(place.path("out/.lumel-checkpoint"));
    const auto resume = [&](const std::string& error, std::vector<std::string> more) {
        more.emplace_back("--resume");
        return run_lumel(resumable(place.path("out"), {.error = error, .more = more}));
    };
    const auto expect_named = [&](const Outcome& outcome, const std::string& options) {
        expect_one_sentence(outcome, 2, {".lumel-checkpoint", "other options: " + options + ";"});
    };
    expect_named(resume("0.002", {}), "--error");
    expect_named(resume("0.001", {"--sky", "1,1,1"}), "--sky");
    expect_named(resume("0.002", {"--sun", "10,20", "--time", "100", "--pages", "2"}),
                 "--error, --pages, --sun, --time");
    expect_one_sentence(resume("0.001", {"--solver", "stochastic"}), 2,
                        {"--resume", "stochastic", "links"});
    std::string damaged = checkpoint;
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
    place.file("out/.lumel-checkpoint", damaged);
    expect_one_sentence(resume("0.001", {}), 2, {".lumel-checkpoint", "damaged"});
    place.file("out/.lumel-checkpoint", checkpoint.substr(0, checkpoint.size() / 3));
    expect_one_sentence(resume("0.001", {}), 2, {".lumel-checkpoint", "damaged"});
    place.file("out/.lumel-checkpoint", "something else");
    expect_one_sentence(resume("0.001", {}), 2, {".lumel-checkpoint", "not a checkpoint"});
    // All of it is as it was left.
    EXPECT_EQ(bytes_of(place.path("out/.lumel-checkpoint")), "something else");
}

TEST(Resume, WithoutACheckpointTheBakeBeginsAnew)
{
    const Workplace place;
    const Outcome bake = run_lumel(resumable(place.path("out"), {.more = {"--resume"}}));
    EXPECT_EQ(bake.code, 0) << bake.err;
    EXPECT_EQ(hidden(place.path("out")), std::vector<std::string>{});
}

TEST(Resume, ABakeThatIsNotToGoOnRemovesTheCheckpoint)
{
    const Workplace place;
    leave_checkpoint(place.path("out"));
    const Outcome bake = run_lumel(resumable(place.path("out"), {.checkpoint = "0"}));
    EXPECT_EQ(bake.code, 0) << bake.err;
    EXPECT_NE(bake.err.find("--resume"), std::string::npos) << bake.err;
    EXPECT_EQ(hidden(place.path("out")), std::vector<std::string>{});
}

TEST(Resume, ABakeThatIsStoppedLeavesTheCheckpointThatItDidNotGoOnFrom)
{
    const Workplace place;
    leave_checkpoint(place.path("out"));
    const std::string checkpoint = bytes_of(place.path("out/.lumel-checkpoint"));
    const auto stop = [&](const Job& job) {
        const Outcome stopped =
            run_lumel(resumable(place.path("out"), job), {.interrupt_at = "rays per lumel"});
        EXPECT_EQ(stopped.code, 130) << stopped.err;
        EXPECT_EQ(bytes_of(place.path("out/.lumel-checkpoint")), checkpoint);
    };
    stop({.error = "0.001", .checkpoint = "60"});
    stop({.error = "0.001", .checkpoint = "0"});
    stop({.error = "0.001", .checkpoint = "0", .more = {"--resume"}});
}

/// As `timeout` stops a program: by a signal to it, and one to its process group.
TEST(Resume, ABakeThatIsStoppedTwiceAtOnceKeepsItsLight)
{
    const Workplace place;
    const Outcome stopped =
        run_lumel(resumable(place.path("out"), {.error = "0.001"}),
                  {.interrupt_at = "rays per lumel", .signal = SIGTERM, .signals = 2});
    EXPECT_EQ(stopped.code, 128 + SIGTERM) << stopped.err;
    EXPECT_TRUE(fs::exists(place.path("out/lightmap.exr")));
}

TEST(Resume, ABakeThatIsStoppedLeavesNoCheckpointWhereNoneWas)
{
    const Workplace place;
    const Outcome stopped = run_lumel(resumable(place.path("out"), {.error = "0.001"}),
                                      {.interrupt_at = "rays per lumel"});
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    EXPECT_EQ(hidden(place.path("out")), std::vector<std::string>{});
}

TEST(Resume, OnlyALongerBakeWritesItsCheckpointOverAnOlderOne)
{
    const Workplace place;
    const double seconds = leave_checkpoint(place.path("out"));
    const auto run = [&](double kill_after, std::vector<std::string> more) {
        run_lumel(resumable(place.path("out"), {.error = "0.001", .more = std::move(more)}),
                  {.kill_after = kill_after});
        return bytes_of(place.path("out/.lumel-checkpoint"));
    };
    const std::string longer = run(2.0 * seconds, {"--resume"});
    EXPECT_EQ(run(seconds, {}), longer);
    EXPECT_NE(run(6.0 * seconds, {}), longer);
}

TEST(Resume, CtrlCKeepsWhatTheNextResumeGoesOnFrom)
{
    const Workplace place;
    const Job resume{.checkpoint = "60", .more = {"--resume"}};
    const Outcome whole = run_lumel(resumable(place.path("whole")));
    ASSERT_EQ(whole.code, 0) << whole.err;
    const Outcome stopped =
        run_lumel(resumable(place.path("out"), resume), {.interrupt_at = "rays per lumel"});
    EXPECT_EQ(stopped.code, 130) << stopped.err;
    ASSERT_TRUE(fs::exists(place.path("out/.lumel-checkpoint")));
    ASSERT_EQ(run_lumel(resumable(place.path("out"), resume)).code, 0);
    EXPECT_EQ(contents(place.path("out")), contents(place.path("whole")));
    EXPECT_EQ(hidden(place.path("out")), std::vector<std::string>{});
}

}  // namespace
}  // namespace lumel::test
