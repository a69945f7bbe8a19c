// Pictures from outside.

#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {
namespace {

std::vector<std::string> tiny_render(const std::string& picture,
                                     const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {
        "render", own_scene("glossy-cornell-box.gltf"), picture, "--size", "32", "--width", "32"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// The arguments of a film of a turning box.
std::vector<std::string> tiny_film(const std::string& picture, const std::string& frames,
                                   const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {"render", own_scene("turning-box.gltf"),
                                          picture,  "--size",
                                          "32",     "--width",
                                          "32",     "--shots",
                                          "64",     "--frames",
                                          frames,   "--fps",
                                          "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> small_render(const std::string& picture,
                                      const std::vector<std::string>& more)
{
    std::vector<std::string> arguments =
        tiny_render(picture, {"--shots", "64", "--eye-shots", "64"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Render, WritesThePictureItsNameAsksFor)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(small_render(place.path("a.png"), {})).code, 0);
    ASSERT_EQ(run_lumel(small_render(place.path("a.exr"), {})).code, 0);
    EXPECT_EQ(bytes_of(place.path("a.png")).substr(1, 3), "PNG");
    EXPECT_EQ(bytes_of(place.path("a.exr")).substr(0, 4), "\x76\x2f\x31\x01");
    ASSERT_EQ(run_lumel(small_render(place.path("b.png"), {"--paths", "4"})).code, 0);
    EXPECT_EQ(bytes_of(place.path("b.png")).substr(1, 3), "PNG");
}

TEST(Render, ByThePapersSchemeTakesNoRaysAndNoShootersForTheEyeAlone)
{
    const Workplace place;
    const std::vector<std::string> papers = {"--scheme", "paper", "--shots", "64", "--error", "1"};
    EXPECT_EQ(run_lumel(tiny_render(place.path("a.png"), papers)).code, 0);
    for (const char* option : {"--lobe-rays", "--eye-shots"}) {
        std::vector<std::string> given = papers;
        given.insert(given.end(), {option, "16"});
        const Outcome outcome = run_lumel(tiny_render(place.path("b.png"), given));
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("--scheme paper"), std::string::npos) << outcome.err;
    }
}

TEST(Render, MakesFramesOfAnAnimation)
{
    const Workplace place;
    for (const std::vector<std::string>& manner :
         {std::vector<std::string>{}, {"--fresh"}, {"--scheme", "paper"}}) {
        std::vector<std::string> arguments = tiny_film(place.path("film.png"), "3", manner);
        arguments.push_back("--json");
        const Outcome outcome = run_lumel(arguments);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(report["files"].size(), 3u);
        EXPECT_EQ(place.listing(),
                  (std::vector<std::string>{"film-0001.png", "film-0002.png", "film-0003.png"}));
        EXPECT_NE(bytes_of(place.path("film-0001.png")), bytes_of(place.path("film-0003.png")));
    }
    EXPECT_EQ(run_lumel(tiny_render(place.path("a.png"), {"--fresh"})).code, 2);
}

/// Bytes of the two frames of a film.
std::array<std::string, 2> two_frames(const Workplace& place, const std::string& name,
                                      const std::vector<std::string>& manner)
{
    const Outcome outcome = run_lumel(tiny_film(place.path(name + ".png"), "2", manner));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return {bytes_of(place.path(name + "-0001.png")), bytes_of(place.path(name + "-0002.png"))};
}

// The first frame has nothing to go on from.
TEST(Render, AFrameGoesOnFromTheOneBeforeUnlessItIsFresh)
{
    const Workplace place;
    const auto first = two_frames(place, "a", {}), again = two_frames(place, "b", {});
    const auto fresh = two_frames(place, "c", {"--fresh"});
    const auto guess = two_frames(place, "d", {"--keep", "0"});
    EXPECT_EQ(first, again);
    EXPECT_EQ(first[0], fresh[0]);
    EXPECT_NE(first[1], fresh[1]);
    EXPECT_NE(first[1], guess[1]);
    EXPECT_NE(guess[1], fresh[1]);
}

TEST(Render, PrintsItsReportAsJson)
{
    const Workplace place;
    for (const char* option : {"--lobe-rays", "--paths"}) {
        const Outcome outcome =
            run_lumel(small_render(place.path("a.png"), {"--json", option, "4"}));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
        ASSERT_FALSE(report.is_discarded()) << outcome.out;
        EXPECT_EQ(report["sizes"]["picture_width"], 32);
        EXPECT_EQ(report["sizes"]["picture_height"], 32);
        EXPECT_EQ(report["files"][0], "a.png");
        EXPECT_EQ(report["solution"]["interrupted"], false);
    }
}

TEST(Render, CtrlCWritesWhatThereIsAndExits130)
{
    const Workplace place;
    struct Work {
        std::string stage;
        std::vector<std::string> options;
    };
    const std::string endless = "2000000000";
    const std::vector<Work> works = {
        {" shots", {"--shots", endless}},
        {"shooting for the eye", {"--shots", "64", "--eye-shots", endless}},
        {"lobe rays", {"--shots", "64", "--eye-shots", "64", "--lobe-rays", "4096"}},
        {"path tracing", {"--paths", "1000000"}},
    };
    for (const Work& work : works) {
        const Outcome outcome =
            run_lumel(tiny_render(place.path("a.png"), work.options), {.interrupt_at = work.stage});
        EXPECT_EQ(outcome.code, 130) << outcome.err;
        EXPECT_NE(outcome.out.find("stopped early"), std::string::npos);
        EXPECT_EQ(place.listing(), std::vector<std::string>{"a.png"});
        std::filesystem::remove(place.path("a.png"));
    }
}

TEST(Render, CtrlCBeforeEveryPixelHasAPathWritesNothing)
{
    const Workplace place;
    const Outcome outcome = run_lumel({"render", own_scene("cornell-box.gltf"), place.path("a.png"),
                                       "--width", "1024", "--paths", "1000000"},
                                      {.interrupt_at = "path tracing"});
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("nothing is written"), std::string::npos) << outcome.err;
    EXPECT_EQ(place.listing(), std::vector<std::string>{});
}

TEST(Render, RefusesWhatItCannotDo)
{
    const Workplace place;
    expect_one_sentence(run_lumel(small_render(place.path("a.jpg"), {})), 2, {"a.jpg", ".png"});
    expect_one_sentence(run_lumel(small_render(place.path("a.png"), {"--camera", "3"})), 2,
                        {"--camera 3", "0"});
    expect_one_sentence(run_lumel(small_render(place.path("no/a.png"), {})), 4, {"no/a.png"});
    expect_one_sentence(run_lumel(small_render("/proc/a.png", {})), 4, {"/proc"});
    const std::string scene = own_scene("glossy-cornell-box.gltf");
    expect_one_sentence(run_lumel({"render", scene, place.path("a.png"), "--size", "32", "--width",
                                   "16384", "--height", "16384"}),
                        2, {"--width 16384", "pixels"});
    expect_one_sentence(
        run_lumel({"render", scene, place.path("a.png"), "--eye-shots", "0", "--lobe-rays", "0"}),
        2, {"--eye-shots 0", "gloss"});
    EXPECT_TRUE(place.listing().empty());
}

}  // namespace
}  // namespace lumel::test
