// Animations from outside.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {
namespace {

std::vector<std::string> small_play(const std::string& folder, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {
        "play", own_scene("turning-box.gltf"), folder, "--size", "32", "--width", "32", "--fps",
        "12"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Play, WritesAPictureAndARowForEachFrame)
{
    const Workplace place;
    for (const std::string redistribution : {"incremental", "cross"}) {
        const Outcome outcome = run_lumel(
            small_play(place.path(redistribution), {"--frames", "3", "--redistribution",
                                                    redistribution, "--hemicube", "64", "--json"}));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
        ASSERT_FALSE(report.is_discarded()) << outcome.out;
        EXPECT_EQ(report,
                  nlohmann::json::parse(bytes_of(place.path(redistribution + "/report.json"))));
        const auto& rows = report["frames"];
        ASSERT_EQ(rows.size(), 3u);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::string name = "frame-000" + std::to_string(k + 1) + ".png";
            EXPECT_EQ(rows[k]["file"], name);
            EXPECT_EQ(bytes_of(place.path(redistribution + "/" + name)).substr(1, 3), "PNG");
            EXPECT_NEAR(rows[k]["time_s"], double(k) / 12.0, 1e-9);
            EXPECT_LE(rows[k]["residual"], 0.002);
            EXPECT_EQ(rows[k]["at_rest"], true);
            EXPECT_GT(rows[k]["hemicubes"], 0);
        }
        EXPECT_NE(bytes_of(place.path(redistribution + "/frame-0001.png")),
                  bytes_of(place.path(redistribution + "/frame-0002.png")));
    }
}

TEST(Play, ABudgetIsKept)
{
    const Workplace place;
    const Outcome outcome =
        run_lumel(small_play(place.path("out"), {"--frames", "2", "--budget", "1", "--json"}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_EQ(report["frames"][0]["at_rest"], false) << outcome.out;
    EXPECT_GT(report["frames"][0]["residual"], 0.002);
}

TEST(Play, CtrlCKeepsTheFramesDoneAndExits130)
{
    const Workplace place;
    // How long is left is said once there is a frame.
    const Outcome outcome =
        run_lumel(small_play(place.path("out"), {"--frames", "100000"}), {.interrupt_at = " left"});
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.out.find("stopped early"), std::string::npos) << outcome.out;
    const auto report = nlohmann::json::parse(bytes_of(place.path("out/report.json")));
    EXPECT_EQ(report["solution"]["interrupted"], true);
    EXPECT_GT(report["frames"].size(), 0u);
}

TEST(Play, CtrlCBeforeThereIsAFrameWritesNothing)
{
    const Workplace place;
    const Outcome outcome =
        run_lumel(small_play(place.path("out"), {"--frames", "2"}), {.interrupt_at = "charts"});
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("nothing is written"), std::string::npos) << outcome.err;
    EXPECT_EQ(place.listing(), std::vector<std::string>{});
}

TEST(Play, AShorterFilmLeavesNoFramesOfALongerOne)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(small_play(place.path("out"), {"--frames", "3", "--budget", "1"})).code, 0);
    ASSERT_TRUE(std::filesystem::exists(place.path("out/frame-0003.png")));
    ASSERT_EQ(run_lumel(small_play(place.path("out"), {"--frames", "1", "--budget", "1"})).code, 0);
    EXPECT_TRUE(std::filesystem::exists(place.path("out/frame-0001.png")));
    EXPECT_FALSE(std::filesystem::exists(place.path("out/frame-0002.png")));
    EXPECT_FALSE(std::filesystem::exists(place.path("out/frame-0003.png")));
}

TEST(Play, RefusesWhatItCannotPlay)
{
    const Workplace place;
    const std::string out = place.path("out");
    expect_one_sentence(run_lumel({"play", own_scene("cornell-box.gltf"), out}), 2,
                        {"cornell-box.gltf", "has no animation"});
    expect_one_sentence(run_lumel(small_play(out, {"--animation", "1"})), 2, {"no animation 1"});
    expect_one_sentence(run_lumel(small_play(out, {"--camera", "1"})), 2, {"--camera 1"});
    expect_one_sentence(run_lumel(small_play(out, {"--redistribution", "guess"})), 2,
                        {"--redistribution", "guess", "cross"});
    expect_one_sentence(run_lumel(small_play(out, {"--leak", "0.1"})), 2,
                        {"--leak", "--solver progressive"});
    expect_one_sentence(
        run_lumel(small_play(out, {"--solver", "directions", "--redistribution", "cross"})), 2,
        {"--redistribution", "--solver directions"});

    std::string scene = bytes_of(own_scene("turning-box.gltf"));
    const std::string turn = "\"path\": \"rotation\"", type = "\"VEC4\"";
    scene.replace(scene.find(turn), turn.size(), "\"path\": \"scale\"");
    scene.replace(scene.find(type), type.size(), "\"VEC3\"");
    expect_one_sentence(run_lumel({"play", place.file("scaled.gltf", scene), out}), 2,
                        {"scaled.gltf", "\"box\"", "stretched"});
    expect_one_sentence(
        run_lumel({"render", place.path("scaled.gltf"), place.path("a.png"), "--frames", "2"}), 2,
        {"scaled.gltf", "\"box\"", "stretched"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"scaled.gltf"});
}

}  // namespace
}  // namespace lumel::test
