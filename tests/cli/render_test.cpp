// Pictures from outside.

#include <gtest/gtest.h>

#include "program.h"

namespace lumel::test {
namespace {

std::vector<std::string> small_render(const std::string& picture,
                                      const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {"render", own_scene("glossy-cornell-box.gltf"),
                                          picture,  "--size",
                                          "32",     "--width",
                                          "32",     "--shots",
                                          "64",     "--eye-shots",
                                          "64"};
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

TEST(Render, RefusesWhatItCannotDo)
{
    const Workplace place;
    expect_one_sentence(run_lumel(small_render(place.path("a.jpg"), {})), 2, {"a.jpg", ".png"});
    expect_one_sentence(run_lumel(small_render(place.path("a.png"), {"--camera", "3"})), 2,
                        {"--camera 3", "0"});
    expect_one_sentence(run_lumel(small_render(place.path("no/a.png"), {})), 4, {"no/a.png"});
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
