// A scene under the hand that is lit by other methods than links, by scripts.

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "edited_scene.h"
#include "played_script.h"

namespace lumel::test {
namespace {

/// Pixels of floor, ceiling and walls.
constexpr std::array<std::array<int, 2>, 9> kPlaces = {
    {{60, 112}, {30, 112}, {95, 112}, {12, 50}, {108, 50}, {60, 45}, {90, 60}, {40, 10}, {80, 12}}};

/// Writes what these pixels have: NAME-0.json and so on.
std::string look(const std::string& name)
{
    std::string script;
    for (std::size_t k = 0; k < kPlaces.size(); ++k)
        script +=
            fmt::format("pick {},{}\nstate {}-{}.json\n", kPlaces[k][0], kPlaces[k][1], name, k);
    return script;
}

double mean_lux(const Played& played, const std::string& name)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < kPlaces.size(); ++k)
        sum += played.state(fmt::format("{}-{}.json", name, k))["pixel"]["illuminance_lx"]
                   .get<double>();
    return sum / double(kPlaces.size());
}

/// Block moved and turned, the other one deleted, a wall painted, the lamp dimmed.
constexpr const char* kEdits = "pick \"short block\"\nmove 0.1,0,0\nturn 20\n"
                               "pick \"tall block\"\ndelete\npick 60,30\npaint 0.2,0.3,0.9\n"
                               "lamp light 0.5,0.4,0.3\n";

/// Of the mean, in per cent: what links and the method state of themselves.
double stated(const Played& played, const std::string& links, const std::string& solved)
{
    return played.state(links + "-0.json")["error"]["mean_percent"].get<double>() +
           played.state(solved + "-0.json")["solved"]["error_percent"].get<double>();
}

TEST(ViewSolve, AMethodAgreesWithLinksOnWhatWasEdited)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "wait\n" + look("before") + kEdits + "wait\n" + look("links") +
                            "solve progressive --error 1\n" + look("solved"));
    const double links = mean_lux(played, "links"), solved = mean_lux(played, "solved");
    EXPECT_NEAR(100.0 * solved / links, 100.0, stated(played, "links", "solved"));
    EXPECT_NE(solved, links);
    EXPECT_LT(links, 0.8 * mean_lux(played, "before"));
    const Json state = played.state("solved-0.json");
    EXPECT_EQ(state["solved"]["method"], "progressive");
    EXPECT_EQ(state["solved"]["limits"]["error"], 0.01);
    EXPECT_EQ(state["solved"]["shown"], true);
    EXPECT_LE(state["solved"]["error_percent"].get<double>(), 1.0);
    EXPECT_GT(state["solved"]["seconds"].get<double>(), 0.0);
    EXPECT_EQ(state["light"]["at_rest"], true);
    EXPECT_EQ(played.state("links-0.json")["solved"], nullptr);
}

TEST(ViewSolve, EveryMethodLightsTheSceneAsItStands)
{
    const std::array<std::string, 7> methods = {"links",
                                                "stochastic",
                                                "glossy",
                                                "directions",
                                                "progressive",
                                                "gather --hemicube 32",
                                                "matrix --patches 300"};
    std::string script = std::string(kEdits) + "wait\n" + look("kept");
    for (std::size_t m = 0; m < methods.size(); ++m)
        script += fmt::format("solve {} --error 4\n", methods[m]) + look(std::to_string(m));
    const Played played(own_scene("cornell-box.gltf"), script, {"--links", "256"}, "32");
    const double links = mean_lux(played, "kept");
    for (std::size_t m = 0; m < methods.size(); ++m)
        EXPECT_NEAR(100.0 * mean_lux(played, std::to_string(m)) / links, 100.0,
                    stated(played, "kept", std::to_string(m)))
            << methods[m];
}

TEST(ViewSolve, SunAndSkyAreThoseOfNow)
{
    const Played played(own_scene("four-cubes.gltf"),
                        "eye 0,8,0.01\nlook 0,0,0\nwait\nsolve stochastic\npick 34,33\n"
                        "state lit.json\nsun 90,45\nsky 0.5\nwait\nstate links.json\n"
                        "solve stochastic\nstate shadow.json\nsun 270,45\nlamp sun 0.25\n"
                        "solve stochastic\nstate dimmed.json\n",
                        {"--sun", "270,45", "--sky", "1000,1000,1000"}, "48");
    const auto lux = [&](const std::string& name) {
        return played.state(name)["pixel"]["illuminance_lx"].get<double>();
    };
    // In the shadow of a cube, once the sun stands in the east.
    EXPECT_GT(lux("lit.json"), 30000.0);
    EXPECT_LT(lux("shadow.json"), 4000.0);
    EXPECT_NEAR(lux("shadow.json") / lux("links.json"), 1.0, 0.1);
    EXPECT_NEAR(lux("dimmed.json") / lux("lit.json"), 0.25, 0.05);
}

TEST(ViewSolve, WhatIsDeletedIsMissing)
{
    const std::string place = "pick 75,85\nstate {}.json\npicture {}.png\n";
    const auto at = [&](const std::string& name) {
        return fmt::format(fmt::runtime(place), name, name);
    };
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 10\nwait\nsolve progressive\n" + at("there") + "delete\nwait\n" +
                            at("links") + "solve progressive\n" + at("gone"),
                        {}, "32");
    EXPECT_EQ(played.state("there.json")["picked"]["name"], "short block");
    EXPECT_EQ(played.state("gone.json")["picked"]["name"], "back wall");
    // Its shadow is gone with it.
    EXPECT_LT(difference(played.picture("gone.png"), played.picture("links.png")).mean, 1.5);
    EXPECT_GT(difference(played.picture("gone.png"), played.picture("there.png")).mean, 4.0);
}

TEST(ViewSolve, GlossIsReadAgainForThePlacesOfNow)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 10\nwait\npicture before.png\npick \"short block\"\n"
                        "move -0.2,0,0\nwait\npicture links.png\nsolve glossy --error 3\n"
                        "picture solved.png\n",
                        {}, "32");
    EXPECT_LT(difference(played.picture("solved.png"), played.picture("links.png")).mean, 3.0);
    EXPECT_GT(difference(played.picture("before.png"), played.picture("links.png")).mean, 6.0);
}

TEST(ViewSolve, TheNextEditReturnsToLinks)
{
    const std::string edit = "pick \"short block\"\nmove -0.1,0,0\n",
                      end = "wait\npicture a.png\nstate a.json\n";
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 10\nwait\nsolve directions --shots 32\npicture solved.png\n" +
                            edit + "picture asked.png\nstate asked.json\n" + end);
    const Played never(own_scene("cornell-box.gltf"),
                       "exposure 10\nwait\n" + edit + "picture asked.png\n" + end);
    EXPECT_EQ(played.state("asked.json")["solved"], nullptr);
    EXPECT_EQ(played.picture("asked.png").rgb, never.picture("asked.png").rgb);
    EXPECT_LE(difference(played.picture("a.png"), never.picture("a.png")).most, 1);
    EXPECT_GT(difference(played.picture("solved.png"), never.picture("asked.png")).mean, 3.0);
}

TEST(ViewSolve, LinksAndWhatWasSolvedAreShownByTurns)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 10\nwait\npicture a.png\npick 30,112\nmode links\n"
                        "picture lines.png\nmode lit\n"
                        "solve directions --shots 32\nstate solved.json\npicture b.png\n"
                        "light links\npicture c.png\nstate c.json\nlight solved\npicture d.png\n"
                        "mode links\npicture lines-too.png\nstate lines.json\n");
    EXPECT_EQ(played.picture("a.png").rgb, played.picture("c.png").rgb);
    EXPECT_EQ(played.picture("b.png").rgb, played.picture("d.png").rgb);
    EXPECT_GT(difference(played.picture("a.png"), played.picture("b.png")).mean, 0.5);
    const Json solved = played.state("solved.json"), links = played.state("c.json");
    EXPECT_EQ(links["solved"]["shown"], false);
    EXPECT_EQ(links["solved"]["seconds"], solved["solved"]["seconds"]);
    EXPECT_NE(links["picked"]["lumel"]["irradiance"], solved["picked"]["lumel"]["irradiance"]);
    // What links show is always their own.
    EXPECT_EQ(played.picture("lines.png").rgb, played.picture("lines-too.png").rgb);
    EXPECT_EQ(played.state("lines.json")["solved"]["shown"], false);
    EXPECT_EQ(links["links"], solved["links"]);
}

TEST(ViewSolve, TheErrorIsWhatTheMethodStates)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "wait\nmode error\nsolve progressive --error 1\nscale 0.1,10\n"
                        "pick 60,110\nstate one.json\npicture one.png\n"
                        "solve stochastic --shots 16\nstate none.json\npicture none.png\n",
                        {}, "32");
    const Json one = played.state("one.json"), none = played.state("none.json");
    EXPECT_NEAR(one["error"]["mean_percent"].get<double>(),
                one["solved"]["error_percent"].get<double>(), 1e-3);
    EXPECT_EQ(one["picked"]["lumel"]["error_percent"], one["error"]["mean_percent"]);
    EXPECT_EQ(none["solved"]["error_percent"], nullptr);
    EXPECT_EQ(none["error"]["mean_percent"], nullptr);
    EXPECT_EQ(none["picked"]["lumel"]["error_percent"], nullptr);
    // One number for all lumels has one colour, and none has that of no surface.
    const Picture picture = played.picture("one.png"), grey = played.picture("none.png");
    EXPECT_EQ(picture.at(60, 110), picture.at(20, 60));
    EXPECT_NE(picture.at(60, 110), grey.at(60, 110));
    EXPECT_EQ(grey.at(60, 110)[0], grey.at(60, 110)[2]);
}

TEST(ViewSolve, ASessionMayBeginWithAMethod)
{
    const Played played(own_scene("cornell-box.gltf"), "state a.json\npicture a.png\n",
                        {"--solver", "stochastic"});
    const Json state = played.state("a.json");
    EXPECT_EQ(state["solved"]["method"], "stochastic");
    EXPECT_EQ(state["light"]["sweeps"], 0);
    EXPECT_GT(played.picture("a.png").mean(), 30.0);
}

TEST(ViewSolve, WhatCannotBeSolvedIsOneSentence)
{
    const Workplace place;
    const auto play = [&](const std::string& script) {
        return run_lumel({"view", own_scene("cornell-box.gltf"), "--script",
                          place.file("s.txt", script), "--headless", "--folder", place.path("out"),
                          "--size", "32", "--width", "16"});
    };
    for (const auto& [script, words] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"wait\nsolve\n", {":2", "METHOD"}},
             {"solve xray\n", {":1", "xray", "progressive"}},
             {"solve progressive --batch 0\n", {":1", "--batch 0", "whole number"}},
             {"solve progressive --layers list\n", {":1", "--layers", "directions"}},
             {"solve directions --lookups 5\n", {":1", "--lookups", "--layers stochastic"}},
             {"solve progressive --error\n", {":1", "--error", "value"}},
             {"solve progressive --error 0\n", {":1", "--error 0"}},
             {"solve progressive --dark-error 5\n", {":1", "--dark-error"}},
             {"solve progressive fast\n", {":1", "fast"}},
             {"light moon\n", {":1", "links | solved"}},
             {"wait\nlight solved\n", {":2", "no solved light"}},
             {"solve stochastic --shots 16\nlamp light 0.5\nlight solved\n",
              {":3", "no solved light"}}})
        expect_one_sentence(play(script), 2, words);
    expect_one_sentence(
        run_lumel({"view", own_scene("cornell-box.gltf"), "--headless", "--solver", "xray"}), 2,
        {"xray", "progressive"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"s.txt"});
}

TEST(ViewSolve, APictureAfterAnEditIsThatOfANewSession)
{
    // What was drawn before is kept on the device: of the map, only rows that differ are sent.
    const std::string one = "lamp light 0.3,0.5,1\n",
                      two = "pick \"short block\"\nmove 0.1,0,-0.05\n",
                      end = "wait\npicture lit.png\nmode irradiance\nscale 1,50\npicture lux.png\n";
    const Played fresh(own_scene("cornell-box.gltf"), "exposure 10\n" + one + two + end);
    const Played edited(own_scene("cornell-box.gltf"), "exposure 10\nwait\npicture a.png\n" + one +
                                                           "wait\npicture b.png\n" + two + end);
    for (const char* name : {"lit.png", "lux.png"})
        EXPECT_LE(difference(edited.picture(name), fresh.picture(name)).most, 2) << name;
    EXPECT_GT(difference(edited.picture("a.png"), edited.picture("b.png")).mean, 5.0);
    EXPECT_GT(difference(edited.picture("b.png"), edited.picture("lit.png")).mean, 1.0);
}

}  // namespace
}  // namespace lumel::test
