// A bake by several processes, which mpirun starts.

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;

constexpr int kInput = 2, kOutput = 4;

const std::vector<std::string> kSmall = {"--size", "64", "--preview-width", "0"};

using Arguments = std::vector<std::string>;

Arguments joined(Arguments words, const Arguments& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Arguments bake_of(const std::string& scene, const std::string& folder, const Arguments& more = {})
{
    return joined(joined({lumel_program(), "bake", scene, folder}, kSmall), more);
}

/// Runs mpirun with a process of each command.
Outcome run_ranks(const std::vector<Arguments>& commands, RunOptions options = {})
{
    Arguments words = {"--oversubscribe", "--bind-to", "none"};
    for (const Arguments& command : commands)
        words = joined(joined(words, {"-n", "1"}), joined(command, {":"}));
    words.pop_back();
    options.environment = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
    return run_program("mpirun", words, options);
}

void expect_words(const std::string& text, const Arguments& words)
{
    for (const std::string& word : words)
        EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
}

class Ranks : public testing::Test {
protected:
    void SetUp() override
    {
        if (run_program("mpirun", {"--version"}).code != 0)
            GTEST_SKIP() << "mpirun is not installed";
        const fs::path programs = fs::path(lumel_program()).parent_path();
        if (!fs::exists(programs.parent_path() / "lib/liblumel-mpi.so"))
            GTEST_SKIP() << "the module for MPI is not built";
    }

    const Workplace place;
    const std::string cornell = own_scene("cornell-box.gltf"), out = place.path("out");
};

TEST_F(Ranks, BakeTheBytesOfOneProcess)
{
    const Arguments more = {"--keep-links", "--error", "2"};
    const Arguments alone = bake_of(cornell, place.path("alone"), more);
    ASSERT_EQ(run_program(alone[0], {alone.begin() + 1, alone.end()}).code, 0);
    const Arguments shared = bake_of(cornell, out, more);
    const Outcome bake = run_ranks({shared, shared});
    ASSERT_EQ(bake.code, 0) << bake.err;
    EXPECT_EQ(std::ranges::count(bake.out, '\n'), 2) << bake.out;
    for (const char* file : {"/lightmap.exr", "/solution.exr", "/scene.lumellinks"})
        EXPECT_TRUE(bytes_of(out + file) == bytes_of(place.path("alone") + file)) << file;
    const auto ranks = nlohmann::json::parse(bytes_of(out + "/report.json"))["ranks"];
    ASSERT_EQ(ranks.size(), 2u);
    EXPECT_GT(ranks[1]["received_bytes"], 0);
}

TEST_F(Ranks, EndWithTheErrorOfOne)
{
    const Outcome bake = run_ranks({bake_of(cornell, out), bake_of("missing.gltf", out)});
    EXPECT_EQ(bake.code, kInput);
    expect_words(bake.err, {"error: rank 1: missing.gltf: "});
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(Ranks, RefuseAFolderThatOneDoesNotSee)
{
    const Outcome bake = run_ranks({bake_of(cornell, out), bake_of(cornell, place.path("other"))});
    EXPECT_EQ(bake.code, kOutput);
    expect_words(bake.err, {out + ": is not seen by rank 1"});
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(Ranks, RefuseWhatTheyCannotShare)
{
    const Arguments progressive = bake_of(cornell, out, {"--solver", "progressive"});
    const Outcome bake = run_ranks({progressive, progressive});
    EXPECT_EQ(bake.code, kInput);
    expect_words(bake.err, {"--solver progressive: cannot be shared by several processes"});
    const Arguments info = {lumel_program(), "info", cornell};
    const Outcome other = run_ranks({info, info});
    EXPECT_EQ(other.code, kInput);
    expect_words(other.err, {"mpirun: can start lumel bake only"});
}

/// mpirun passes SIGUSR1 on to all.
TEST_F(Ranks, KeepTheLightSoFarWhenStopped)
{
    const Arguments bake = bake_of(cornell, out, {"--error", "0.01", "--verbose"});
    const Outcome stopped =
        run_ranks({bake, bake}, {.interrupt_at = "estimated error", .signal = SIGUSR1});
    EXPECT_EQ(stopped.code, 128 + SIGUSR1) << stopped.err;
    expect_words(stopped.out, {"stopped early"});
    EXPECT_NE(bytes_of(out + "/lightmap.exr"), "");
    const auto report = nlohmann::json::parse(bytes_of(out + "/report.json"));
    EXPECT_TRUE(report["solution"]["interrupted"]);
}

TEST_F(Ranks, ContinueWhatAnotherNumberOfThemHasBegun)
{
    const Arguments more = {"--error", "0.5"};
    const Arguments alone = bake_of(cornell, place.path("alone"), more);
    ASSERT_EQ(run_program(alone[0], {alone.begin() + 1, alone.end()}).code, 0);
    const Arguments bake = bake_of(cornell, out, joined(more, {"--resume", "--verbose"}));
    const Outcome stopped =
        run_ranks({bake, bake}, {.interrupt_at = "estimated error", .signal = SIGUSR1});
    EXPECT_EQ(stopped.code, 128 + SIGUSR1) << stopped.err;
    EXPECT_TRUE(fs::exists(out + "/.lumel-checkpoint"));
    const Outcome continued = run_ranks({bake, bake, bake});
    EXPECT_EQ(continued.code, 0) << continued.err;
    expect_words(continued.err, {"continuing after"});
    EXPECT_TRUE(bytes_of(out + "/lightmap.exr") == bytes_of(place.path("alone/lightmap.exr")));
}

TEST_F(Ranks, NeedTheModule)
{
    fs::create_directories(place.path("bin"));
    fs::copy_file(lumel_program(), place.path("bin/lumel"));
    const Outcome bake = run_program(place.path("bin/lumel"), {"bake", cornell, out},
                                     {.environment = {"OMPI_COMM_WORLD_SIZE=2"}});
    expect_one_sentence(bake, kInput, {"liblumel-mpi.so", "lumel-mpi", "-DLUMEL_MPI=ON"});
}

}  // namespace
}  // namespace lumel::test
