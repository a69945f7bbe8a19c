// Light probes that lumel view shows.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "played_script.h"

namespace lumel::test {
namespace {

double luminance_at(const Json& coefficients, std::size_t number)
{
    const auto channel = [&](std::size_t c) { return coefficients[3 * number + c].get<double>(); };
    return 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
}

TEST(ViewProbes, AreThoseOfABake)
{
    const Workplace place;
    const std::string scene = own_scene("cornell-box.gltf"), folder = place.path("baked");
    ASSERT_EQ(run_lumel({"bake", scene, folder, "--size", "64", "--error", "1", "--preview-width",
                         "0", "-q"})
                  .code,
              0);
    const Outcome outcome = run_lumel({"probes", folder, "--spacing", "0.18", "--json"});
    const Json baked = Json::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(baked.is_discarded()) << outcome.err;
    const Played played(scene, "probes 0.18\nwait\nstate a.json\nsolve stochastic\nstate b.json\n",
                        {"--links", "256"});
    for (const char* name : {"a.json", "b.json"}) {
        const Json shown = played.state(name)["probes"];
        EXPECT_EQ(shown["spacing_m"], 0.18);
        std::size_t k = 0;
        for (const Json& probe : baked["probes"]) {
            if (probe["inside"])
                continue;
            ASSERT_LT(k, shown["probes"].size());
            const Json& mine = shown["probes"][k++];
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(mine["position"][axis].get<double>(),
                            probe["position"][axis].get<double>(), 1e-5);
            const double all = luminance_at(probe["coefficients"], 0);
            for (std::size_t c = 0; c < 9; ++c)
                EXPECT_NEAR(luminance_at(mine["coefficients"], c) / all,
                            luminance_at(probe["coefficients"], c) / all, 0.05)
                    << k << ' ' << c;
        }
        EXPECT_EQ(k, shown["probes"].size());
    }
}

TEST(ViewProbes, AreDrawnBeforeWhatTheyHide)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 1\nwait\npicture plain.png\nmode irradiance\npicture lux.png\n"
                        "probes 0.15\npicture lux-balls.png\nmode lit\npicture balls.png\n"
                        "mode lumels\npicture lumels-balls.png\nprobes off\npicture lumels.png\n"
                        "mode lit\npicture off.png\n"
                        // Behind the wall at the back, which hides all of them.
                        "eye 0.278,0.273,1.2\nlook 0.278,0.273,0.5\npicture behind.png\n"
                        "probes 0.15\npicture behind-balls.png\n");
    const auto other_pixels = [&](const char* name, const char* with_balls) {
        const Picture a = played.picture(name), b = played.picture(with_balls);
        int count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x)
                count += a.at(x, y) != b.at(x, y);
        return count;
    };
    // A ball is a few pixels wide.
    EXPECT_GT(other_pixels("plain.png", "balls.png"), 100);
    EXPECT_GT(other_pixels("lux.png", "lux-balls.png"), 100);
    EXPECT_EQ(played.picture("plain.png").rgb, played.picture("off.png").rgb);
    EXPECT_EQ(played.picture("lumels.png").rgb, played.picture("lumels-balls.png").rgb);
    EXPECT_EQ(played.picture("behind.png").rgb, played.picture("behind-balls.png").rgb);
}

/// Of links, which all lights share; bakes at rest would differ by their noise.
TEST(ViewProbes, FollowTheLight)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "probes 0.18\nexposure 1\nwait\nstate white.json\nlamp light 0,1,0\nwait\n"
                        "state green.json\npicture green.png\nlamp light 0\nwait\n"
                        "state dark.json\npicture dark.png\n",
                        {"--error", "0"});
    const Json white = played.state("white.json")["probes"]["probes"],
               green = played.state("green.json")["probes"]["probes"],
               dark = played.state("dark.json")["probes"]["probes"];
    ASSERT_GT(white.size(), 8u);
    ASSERT_EQ(green.size(), white.size());
    for (std::size_t k = 0; k < white.size(); ++k) {
        // What is still to come at rest.
        EXPECT_LT(green[k]["coefficients"][0].get<double>(),
                  2e-4 * white[k]["coefficients"][0].get<double>());
        EXPECT_NEAR(green[k]["coefficients"][1].get<double>() /
                        white[k]["coefficients"][1].get<double>(),
                    1.0, 0.02);
        for (std::size_t c = 0; c < 27; ++c)
            EXPECT_EQ(dark[k]["coefficients"][c], 0.0);
    }
    EXPECT_EQ(played.picture("dark.png").most(), 0);
    const Picture picture = played.picture("green.png");
    int red = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            red += picture.at(x, y)[0] > picture.at(x, y)[1];
    EXPECT_EQ(red, 0);
}

TEST(ViewProbes, StayWhereTheyWereAskedFor)
{
    // A grid over all that there is after the move would have far more than may be shown.
    const Played played(own_scene("cornell-box.gltf"),
                        "probes 0.18\nstate early.json\nwait\nstate a.json\npick \"short block\"\n"
                        "move 100,100,0\nwait\nstate b.json\n");
    const auto places = [&](const char* name) {
        std::vector<Json> all;
        const Json state = played.state(name);
        for (const Json& probe : state["probes"]["probes"])
            all.push_back(probe["position"]);
        return all;
    };
    EXPECT_TRUE(places("early.json").empty());  // no light was at rest yet
    const std::vector<Json> before = places("a.json"), after = places("b.json");
    EXPECT_GT(before.size(), 8u);
    for (const Json& place : before)
        EXPECT_NE(std::find(after.begin(), after.end(), place), after.end()) << place;
}

TEST(ViewProbes, TooManyAreOneSentence)
{
    const Workplace place;
    for (const auto& [script, words] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"wait\nprobes 0.01\n", {":2", "2000", "spacing"}},
             {"probes 0.001\n", {":1", "probes"}},
             {"probes none\n", {":1", "SPACING | off"}}})
        expect_one_sentence(run_lumel({"view", own_scene("cornell-box.gltf"), "--script",
                                       place.file("s.txt", script), "--headless", "--folder",
                                       place.path("out"), "--size", "32", "--width", "16"}),
                            2, words);
}

}  // namespace
}  // namespace lumel::test
