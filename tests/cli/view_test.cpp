// A lit scene under the hand, by scripts.

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "edited_scene.h"
#include "played_script.h"

namespace lumel::test {
namespace {

/// The node of that name.
Json& node_of(EditedScene& scene, const std::string& name)
{
    for (Json& node : scene.json()["nodes"])
        if (node.value("name", "") == name)
            return node;
    throw std::runtime_error("no node " + name);
}

TEST(View, ALampThatIsPutOutLeavesDarknessInTheSameFrame)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "wait\npicture lit.png\n"
                        "lamp light 0\nframes 1\npicture dark.png\nstate dark.json\n"
                        "lamp light 1,0,0\nwait\npicture red.png\n",
                        {"--budget", "1000"});
    EXPECT_GT(played.picture("lit.png").mean(), 30.0);
    EXPECT_EQ(played.picture("dark.png").most(), 0);
    EXPECT_EQ(played.state("dark.json")["light"]["links_traced_again"], 0);
    const Colour red = played.picture("red.png").at(60, 100);
    // The tone curve mixes in a little grey.
    EXPECT_GT(red[0], 60);
    EXPECT_LT(red[1], red[0] / 2);
    EXPECT_LT(red[2], red[0] / 2);
}

TEST(View, ADoorThatIsOpenedLightsTheRoomBehind)
{
    EditedScene scene("two-rooms.gltf");
    scene.add_block("door", {2.3f, -0.3f, 2.95f}, {3.8f, 2.4f, 3.1f});
    const Workplace place;
    const Played played(scene.write(place),
                        "exposure 2\nwait\npicture closed.png\n"
                        "pick door\nmove -1.6,0,0\n"
                        "state asked.json\nwait\npicture open.png\nstate open.json\n"
                        "move 1.6,0,0\nwait\npicture again.png\n",
                        {}, "128");
    // At the frame of the door a little light of the other room is in lumels that both see.
    EXPECT_LT(played.picture("closed.png").mean(), 0.5);
    EXPECT_GT(played.picture("open.png").mean(), 80.0);
    EXPECT_LT(difference(played.picture("closed.png"), played.picture("again.png")).mean, 0.1);
    EXPECT_EQ(played.state("asked.json")["light"]["links_traced_again"], 0);
    EXPECT_GT(played.state("open.json")["light"]["links_traced_again"], 0);
    EXPECT_EQ(played.state("open.json")["light"]["at_rest"], true);
}

TEST(View, PickingHitsWhatIsUnderThePixel)
{
    // From straight above, 90 degrees of view, the floor below is as wide as twice the height.
    EditedScene scene("four-cubes.gltf");
    for (Json& camera : scene.json()["cameras"])
        camera["perspective"] = {{"yfov", std::acos(-1.0) / 2.0},
                                 {"aspectRatio", 1.0},
                                 {"znear", 0.01},
                                 {"zfar", 100.0}};
    node_of(scene, "camera")["matrix"] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 6, 0, 1};
    const Workplace place;
    const double height = 6.0, top = 1.2;  // of the orange cube at x = -0.8, z = -0.5
    const auto pixel = [&](double x, double y, double z) {
        const double scale = 60.0 / (height - y);
        return fmt::format("pick {:.0f},{:.0f}\n", std::floor(60.0 + scale * x),
                           std::floor(60.0 + scale * z));
    };
    const Played played(scene.write(place),
                        "wait\n" + pixel(-0.8, top, -0.5) + "state cube.json\n" +
                            pixel(1.5, 0.0, 1.5) + "state slab.json\n" + "pick 1,1\n" +
                            "state nothing.json\n",
                        {"--sky", "100,100,100"});
    const Json cube = played.state("cube.json")["picked"];
    EXPECT_EQ(cube["name"], "orange cube");
    EXPECT_EQ(cube["material"], "orange cube");
    EXPECT_EQ(cube["movable"], true);
    EXPECT_NEAR(cube["place"][0], -0.8, 0.1);
    EXPECT_NEAR(cube["place"][1], top, 1e-4);
    EXPECT_NEAR(cube["place"][2], -0.5, 0.1);
    EXPECT_NEAR(cube["normal"][1], 1.0, 1e-5);
    // Nothing stands above it: it has all of the light of the sky, π L.
    EXPECT_NEAR(cube["lumel"]["illuminance_lx"], std::acos(-1.0) * 100.0, 1.0);
    const Json slab = played.state("slab.json");
    EXPECT_EQ(slab["picked"]["name"], "slab");
    EXPECT_EQ(slab["picked"]["movable"], false);
    // What a diffuse surface sends of it: L = ρ H / π.
    EXPECT_NEAR(slab["pixel"]["luminance_cd_m2"].get<double>(),
                (0.2126 * 0.7 + 0.7152 * 0.68 + 0.0722 * 0.65) / std::acos(-1.0) *
                    slab["pixel"]["illuminance_lx"].get<double>(),
                0.01);
    const Json nothing = played.state("nothing.json");
    EXPECT_EQ(nothing["picked"], nullptr);
    EXPECT_EQ(nothing["pixel"]["luminance_cd_m2"], 0.0);
    EXPECT_EQ(nothing["pixel"]["illuminance_lx"], nullptr);
}

TEST(View, WalkingShowsWhatACameraThereShows)
{
    const Workplace place;
    EditedScene scene("cornell-box.gltf");
    // It looks along +z, with +x to its left.
    Json& matrix = node_of(scene, "camera")["matrix"];
    matrix[12] = 0.278 - 0.05;
    matrix[13] = 0.273 + 0.04;
    matrix[14] = -0.8 + 0.3;
    const std::string end = "exposure 1\nwait\npicture a.png\n";
    const Played there(scene.write(place), end);
    const Played walked(own_scene("cornell-box.gltf"), "walk 0.3,0.05,0.04\n" + end);
    const Played stayed(own_scene("cornell-box.gltf"), end);
    EXPECT_LE(difference(walked.picture("a.png"), there.picture("a.png")).most, 2);
    EXPECT_GT(difference(stayed.picture("a.png"), there.picture("a.png")).mean, 3.0);
}

TEST(View, OrbitingAllAroundComesBackAndKeepsWhatIsPickedInPlace)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "eye 0.278,0.3,-0.8\nlook 0.278,0.25,0.28\nwait\npick \"tall block\"\n"
                        "picture before.png\norbit 40,10\nstate aside.json\npicture aside.png\n"
                        "orbit -40,-10\npicture after.png\n");
    EXPECT_LE(difference(played.picture("before.png"), played.picture("after.png")).mean, 0.05);
    EXPECT_GT(difference(played.picture("before.png"), played.picture("aside.png")).mean, 3.0);
    const Json aside = played.state("aside.json");
    const Json &eye = aside["camera"]["eye"], &middle = aside["picked"]["place"];
    double now = 0.0, then = 0.0;
    const std::array<double, 3> start = {0.278, 0.3, -0.8};
    for (std::size_t c = 0; c < 3; ++c) {
        now += std::pow(eye[c].get<double>() - middle[c].get<double>(), 2);
        then += std::pow(start[c] - middle[c].get<double>(), 2);
    }
    EXPECT_NEAR(std::sqrt(now), std::sqrt(then), 1e-4);
    EXPECT_GT(eye[1].get<double>(), start[1]);
}

TEST(View, DeletingAThingShowsWhatIsBehind)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "wait\npick 75,85\nstate before.json\ndelete\nwait\nstate after.json\n"
                        "pick 75,85\nstate behind.json\npicture gone.png\n");
    EXPECT_EQ(played.state("before.json")["picked"]["name"], "short block");
    EXPECT_EQ(played.state("after.json")["picked"], nullptr);
    const Json behind = played.state("behind.json");
    EXPECT_EQ(behind["picked"]["name"], "back wall");

    // Light and picture are those of a scene without it, whose lumels lie elsewhere in the map.
    EditedScene scene("cornell-box.gltf");
    Json& nodes = scene.json()["scenes"][0]["nodes"];
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (scene.json()["nodes"][nodes[n].get<std::size_t>()]["name"] == "short block") {
            nodes.erase(n);
            break;
        }
    const Workplace place;
    const Played without(scene.write(place), "wait\npick 75,85\nstate a.json\npicture a.png\n");
    EXPECT_NEAR(behind["pixel"]["luminance_cd_m2"].get<double>() /
                    without.state("a.json")["pixel"]["luminance_cd_m2"].get<double>(),
                1.0, 0.05);
    EXPECT_LT(difference(played.picture("gone.png"), without.picture("a.png")).mean, 2.0);
}

TEST(View, FalseColoursAreThoseOfTheLegendAtTheirIlluminance)
{
    std::string script = "wait\nmode irradiance\npicture lux.png\n";
    const std::array<std::array<int, 2>, 4> pixels = {{{60, 110}, {8, 60}, {60, 40}, {112, 80}}};
    for (std::size_t k = 0; k < pixels.size(); ++k)
        script += fmt::format("pick {},{}\nstate {}.json\n", pixels[k][0], pixels[k][1], k);
    const Played played(own_scene("cornell-box.gltf"), script);
    const Picture picture = played.picture("lux.png");
    const Json first = played.state("0.json");
    const int width = first["picture"]["width"], column = width + 20;  // within the bar
    ASSERT_GT(picture.width, width);
    // The bar lies between the margins: where its colours change from row to row.
    const Colour paper = picture.at(width + 3, 3);
    int top = picture.height / 2, bottom = top;
    while (picture.at(column, top - 1) != paper)
        --top;
    while (bottom + 1 < picture.height && picture.at(column, bottom + 1) != paper)
        ++bottom;
    const double low = first["scale_lx"][0], high = first["scale_lx"][1];
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const double lux = played.state(fmt::format("{}.json", k))["pixel"]["illuminance_lx"];
        const double share = std::log(lux / low) / std::log(high / low);
        ASSERT_GT(share, 0.0);
        ASSERT_LT(share, 1.0);
        const int row = bottom - int(std::lround(share * (bottom - top)));
        const Colour shown = picture.at(pixels[k][0], pixels[k][1]);
        const Colour legend = picture.at(column, row);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(shown[c], legend[c], 3) << k;
    }
}

TEST(View, WhatIsNotSettledIsShownInPerCent)
{
    const auto play = [](const std::string& rays) {
        return Played(own_scene("cornell-box.gltf"),
                      "mode error\nstate first.json\nwait\nstate rest.json\n"
                      "pick 60,110\nscale 0.5,50\npicture error.png\nstate floor.json\n",
                      {"--links", rays, "--error", "0"});
    };
    const Played few = play("16"), many = play("256");
    const auto mean = [](const Played& played, const std::string& name) {
        return played.state(name)["error"]["mean_percent"].get<double>();
    };
    EXPECT_EQ(few.state("floor.json")["mode"], "error");
    EXPECT_GT(mean(few, "first.json"), 80.0);
    // Noise falls by the root of the rays at least: by four.
    EXPECT_GT(mean(few, "rest.json"), 3.0 * mean(many, "rest.json"));
    EXPECT_GT(mean(many, "rest.json"), 0.05);
    // Lighter colours stand for more.
    EXPECT_GT(few.picture("error.png").at(60, 110)[1], many.picture("error.png").at(60, 110)[1]);
    EXPECT_EQ(few.state("floor.json")["error"]["scale_percent"], Json::array({0.5, 50.0}));
    EXPECT_GT(few.picture("error.png").width, few.state("floor.json")["picture"]["width"]);
}

TEST(View, AStopMoreIsTwiceAsBright)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "exposure 0.002\nwait\npick 60,110\npicture one.png\nstate one.json\n"
                        "ev 1\npicture two.png\nstate two.json\n"
                        "ev -1\nexposure 0.004\npicture same.png\n"
                        "exposure auto\nstate auto.json\n");
    const Json one = played.state("one.json"), two = played.state("two.json");
    EXPECT_NEAR(one["exposure"]["factor"].get<double>(), 0.002, 1e-9);
    EXPECT_NEAR(two["exposure"]["factor"].get<double>(), 0.004, 1e-9);
    EXPECT_EQ(one["pixel"]["luminance_cd_m2"], two["pixel"]["luminance_cd_m2"]);
    EXPECT_EQ(played.picture("two.png").rgb, played.picture("same.png").rgb);
    EXPECT_GT(played.picture("two.png").mean(), played.picture("one.png").mean());
    EXPECT_EQ(played.state("auto.json")["exposure"]["automatic"], true);
}

TEST(View, AShadowMovesWithTheSun)
{
    // The orange cube is 1.2 m high, at x = -0.8, z = -0.5. From the east, at 45 degrees, its
    // shadow reaches to the west of it; from the west, to the east.
    const Played played(own_scene("four-cubes.gltf"),
                        "eye 0,8,0.01\nlook 0,0,0\nwait\n"
                        "pick 34,33\nstate west_lit.json\n"
                        "sun 270,45\nwait\nstate west_sun.json\n"
                        "sun 90,-5\nwait\nstate night.json\n",
                        {"--sun", "90,45", "--sky", "0,0,0"});
    const Json shadow = played.state("west_lit.json"), lit = played.state("west_sun.json");
    ASSERT_EQ(shadow["picked"]["name"], "slab");
    ASSERT_NEAR(shadow["picked"]["place"][1], 0.0, 1e-3);
    EXPECT_LT(shadow["picked"]["place"][0], -1.45);
    EXPECT_GT(shadow["picked"]["place"][0], -2.0);
    EXPECT_LT(shadow["pixel"]["illuminance_lx"].get<double>(), 2000.0);
    EXPECT_GT(lit["pixel"]["illuminance_lx"].get<double>(), 30000.0);
    EXPECT_EQ(lit["sun"]["azimuth"], 270.0);
    EXPECT_EQ(played.state("night.json")["pixel"]["illuminance_lx"], 0.0);
}

TEST(View, AClearSkyIsThatOfItsSunWhereItStands)
{
    // From noon to evening it darkens, and its bright part goes round.
    const std::string look = "lamp sun 0\neye 0,8,0.01\nlook 0,0,0\nexposure 0.0001\n",
                      end = "wait\npick 34,33\nstate s.json\npicture a.png\n";
    const Played evening(own_scene("four-cubes.gltf"), look + end, {"--sun", "250,10"});
    const Played noon(own_scene("four-cubes.gltf"), look + end, {"--sun", "180,62"});
    const Played moved(own_scene("four-cubes.gltf"), look + "wait\nsun 250,10\n" + end,
                       {"--sun", "180,62"});
    const auto lux = [](const Played& played) {
        return played.state("s.json")["pixel"]["illuminance_lx"].get<double>();
    };
    EXPECT_NEAR(lux(moved) / lux(evening), 1.0, 1e-3);
    EXPECT_GT(lux(noon), 1.5 * lux(evening));
    EXPECT_LE(difference(moved.picture("a.png"), evening.picture("a.png")).most, 1);
    EXPECT_GT(difference(noon.picture("a.png"), evening.picture("a.png")).mean, 3.0);
}

TEST(View, ATurnedSkyLightsWhatItFaces)
{
    // The sun's sky is brightest around the sun; the wall of the cube that faces it has most.
    const Played played(own_scene("four-cubes.gltf"),
                        "lamp sun 0\neye 6,0.6,-0.5\nlook -0.8,0.6,-0.5\nwait\n"
                        "pick 60,36\nstate towards.json\n"
                        "turn-sky 180\nwait\nstate away.json\nturn-sky 0\nwait\nstate back.json\n",
                        {"--sun", "90,20"});
    const double towards = played.state("towards.json")["pixel"]["illuminance_lx"];
    EXPECT_GT(towards, 2.0 * played.state("away.json")["pixel"]["illuminance_lx"].get<double>());
    EXPECT_NEAR(played.state("back.json")["pixel"]["illuminance_lx"].get<double>(), towards,
                1e-3 * towards);
}

TEST(View, AtRestAfterMovesIsANewSolution)
{
    // Where the file has them, things are not moved at all.
    EditedScene scene("four-cubes.gltf");
    node_of(scene, "blue cube")["translation"] = {0.7, 0.0, -1.2};
    const Workplace place;
    const std::vector<std::string> light = {"--sun", "120,40"};
    const Played anew(scene.write(place), "exposure 0.0001\nwait\npicture a.png\n", light);
    const Played moved(own_scene("four-cubes.gltf"),
                       "exposure 0.0001\nwait\npicture before.png\npick \"blue cube\"\n"
                       "move 0.5,0,0.7\nframes 2\nmove -0.7,0,-1.3\nturn 30\nturn -30\n"
                       "wait\npicture a.png\nstate a.json\n",
                       light);
    EXPECT_EQ(moved.state("a.json")["light"]["at_rest"], true);
    EXPECT_LT(difference(moved.picture("a.png"), anew.picture("a.png")).mean, 0.05);
    EXPECT_GT(difference(moved.picture("before.png"), anew.picture("a.png")).mean, 2.0);
}

TEST(View, TheAnimationIsWhereTimeHasIt)
{
    const Workplace place;
    const Outcome played =
        run_lumel({"play", own_scene("turning-box.gltf"), place.path("film"), "--solver", "links",
                   "--size", "64", "--width", "120", "--fps", "8", "--frames", "4", "--film",
                   "none", "--exposure", "1"});
    ASSERT_EQ(played.code, 0) << played.err;
    const Played viewed(own_scene("turning-box.gltf"),
                        "exposure 1\nwait\ntime 0.375\nwait\npicture a.png\n");
    const Picture picture = viewed.picture("a.png");
    const auto frame = [&](int number) {
        return read_picture(place.path(fmt::format("film/frame-000{}.png", number)));
    };
    EXPECT_LT(difference(picture, frame(4)).mean, 0.2);
    EXPECT_GT(difference(picture, frame(1)).mean, 2.0);
}

TEST(View, APictureAfterOthersIsTheOneThatAFreshSessionMakes)
{
    // What is kept between pictures, and what is not: places, colours, map, camera and mode.
    const std::string edits = "pick \"tall block\"\ndelete\npick \"short block\"\n"
                              "move 0.1,0.05,0\nturn 25\npaint 0,0.5,1\neye 0.3,0.3,-0.7\n",
                      last = "picture lit.png\nmode irradiance\npicture lux.png\n"
                             "mode lumels\npicture lumels.png\n";
    const Played fresh(own_scene("cornell-box.gltf"), "exposure 2\nwait\n" + edits + last);
    std::string long_way = "exposure 2\nwait\npicture a.png\npicture b.png\nmode lumels\n"
                           "picture c.png\nmode lit\n";
    int number = 0;
    std::istringstream lines(edits);
    for (std::string line; std::getline(lines, line);)
        long_way += fmt::format("{}\npicture {}.png\n", line, number++);
    const Played kept(own_scene("cornell-box.gltf"), long_way + last);
    EXPECT_EQ(kept.picture("a.png").rgb, kept.picture("b.png").rgb);
    EXPECT_GT(difference(kept.picture("a.png"), kept.picture("lit.png")).mean, 3.0);
    for (const char* name : {"lit.png", "lux.png", "lumels.png"})
        EXPECT_EQ(kept.picture(name).rgb, fresh.picture(name).rgb) << name;
}

TEST(View, PaintAndLumelsAreShown)
{
    const Played played(own_scene("cornell-box.gltf"),
                        "wait\npick 60,30\npaint 0,0,1\nwait\npicture blue.png\n"
                        "mode lumels\npicture lumels.png\n");
    const Colour blue = played.picture("blue.png").at(60, 40);
    EXPECT_GT(blue[2], blue[0] + 30);
    EXPECT_GT(blue[2], blue[1] + 30);
    EXPECT_GT(played.picture("lumels.png").mean(), 30.0);
}

TEST(View, LinksOfALumelGoToWhatItSees)
{
    // A wall does not see itself, nor what stands at its other side.
    const Played played(
        own_scene("cornell-box.gltf"),
        "wait\npick 60,5\nstate ceiling.json\npick 30,112\nstate floor.json\n"
        "picture lit.png\nmode links\npicture links.png\npick 6,60\nstate wall.json\n"
        "lamp light 0\nwait\nstate dark.json\n",
        {"--links", "256"});
    const auto share = [](const Json& state, const std::string& name) {
        for (const Json& one : state["links"]["by_name"])
            if (one["name"] == name)
                return one["share"].get<double>();
        return 0.0;
    };
    const Json floor = played.state("floor.json"), wall = played.state("wall.json");
    ASSERT_EQ(floor["picked"]["name"], "floor");
    EXPECT_EQ(floor["links"]["count"], 256);
    EXPECT_EQ(share(floor, "floor"), 0.0);
    EXPECT_GT(share(floor, "light"), 0.5);
    double all = 0.0;
    for (const Json& one : floor["links"]["by_name"])
        all += one["share"].get<double>();
    EXPECT_NEAR(all, 1.0, 1e-6);
    // No ray meets the lamp by chance where it is not seen: what links bring is what arrives.
    const Json ceiling = played.state("ceiling.json");
    ASSERT_EQ(ceiling["picked"]["name"], "ceiling");
    EXPECT_EQ(share(ceiling, "light"), 0.0);
    EXPECT_NEAR(ceiling["links"]["illuminance_lx"].get<double>() /
                    ceiling["picked"]["lumel"]["illuminance_lx"].get<double>(),
                1.0, 0.1);
    const std::string name = wall["picked"]["name"];
    EXPECT_EQ(share(wall, name), 0.0) << name;
    EXPECT_EQ(played.state("dark.json")["links"]["illuminance_lx"], 0.0);
    // Lines in colours, where the dimmed scene behind them is grey.
    const Picture links = played.picture("links.png");
    int coloured = 0;
    for (int y = 0; y < links.height; ++y)
        for (int x = 0; x < links.width; ++x) {
            const Colour colour = links.at(x, y);
            coloured += *std::max_element(colour.begin(), colour.end()) -
                            *std::min_element(colour.begin(), colour.end()) >
                        40;
        }
    EXPECT_GT(coloured, 200);
    EXPECT_GT(difference(links, played.picture("lit.png")).mean, 5.0);
}

TEST(View, ASavedSceneIsABakeOfWhatWasSeen)
{
    const std::string look = "exposure 10\nwait\npicture a.png\nstate a.json\n";
    const Played played(own_scene("cornell-box.gltf"),
                        "pick \"short block\"\nmove 0.1,0,0\nturn 20\npick \"tall block\"\n"
                        "delete\npick 60,30\npaint 0,0,1\nlamp light 0.5,0.25,0.25\n" +
                            look + "save saved\n");
    const std::string saved = played.place.path("out/saved");
    const Played again(saved + "/scene.glb", look);
    EXPECT_LT(difference(again.picture("a.png"), played.picture("a.png")).mean, 1.5);
    const Played before(own_scene("cornell-box.gltf"), look);
    EXPECT_GT(difference(before.picture("a.png"), played.picture("a.png")).mean, 10.0);
    const Json report = Json::parse(bytes_of(saved + "/report.json"), nullptr, false);
    ASSERT_FALSE(report.is_discarded());
    EXPECT_EQ(report["scene"]["file"], "cornell-box.glb");
    EXPECT_FALSE(bytes_of(saved + "/lightmap.exr").empty());
}

TEST(View, WhatAFileCannotHoldIsNotSaved)
{
    const Workplace place;
    const std::string file = place.file("s.txt", "turn-sky 40\nsave saved\n");
    expect_one_sentence(
        run_lumel({"view", own_scene("four-cubes.gltf"), "--script", file, "--headless", "--folder",
                   place.path("out"), "--size", "32", "--width", "16", "--sun", "90,45"}),
        2, {":2", "sky"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"s.txt"});
}

TEST(View, WrongLinesAreOneSentenceWithTheirNumber)
{
    const Workplace place;
    const std::string scene = own_scene("cornell-box.gltf"), out = place.path("out");
    const auto play = [&](const std::string& script) {
        const std::string file = place.file("script.txt", script);
        return run_lumel({"view", scene, "--script", file, "--headless", "--folder", out, "--size",
                          "32", "--width", "16"});
    };
    for (const auto& [script, words] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"wait\n# a comment\nfly 1\n", {":3", "\"fly\"", "--help"}},
             {"wait 2\n", {":1", "wait takes nothing", "2"}},
             {"frames 1.5\n", {":1", "frames takes N", "1.5"}},
             {"frames 0\n", {":1", "frames takes N"}},
             {"eye 1,2\n", {":1", "X,Y,Z"}},
             {"eye 1,2,nan\n", {":1", "X,Y,Z"}},
             {"dim 1,2\n", {":1", "R,G,B"}},
             {"lamp light\n", {":1", "NAME"}},
             {"pick \"tall block\n", {":1", "quote"}},
             {"mode xray\n", {":1", "lit"}},
             {"picture a.jpg\n", {":1", "FILE.png"}},
             {"picture ../a.png\n", {":1", "FILE.png"}},
             {"state a.json\nstate a.json\n", {":2", "a.json"}},
             {"picture a.png\nlamp nothing 1\n", {":2", "\"nothing\"", "\"light\""}},
             {"picture a.png\npick nothing\n", {":2", "nothing"}},
             {"picture a.png\npick 16,3\n", {":2", "16,3"}},
             {"picture a.png\nmove 1,0,0\n", {":2", "nothing is picked"}},
             {"picture a.png\npick floor\nmove 1,0,0\n", {":3", "\"floor\"", "--movable"}},
             {"picture a.png\npick floor\ndim 2\n", {":3", "\"floor\""}},
             {"picture a.png\ncamera 1\n", {":2", "camera 1"}},
             {"picture a.png\nsun 90,45\n", {":2", "--sun"}},
             {"picture a.png\nturn-sky 90\n", {":2", "sky"}},
             {"scale 5,5\n", {":1", "scale"}},
             {"save ../a\n", {":1", "FOLDER"}},
             {"picture a.png\nwindow b.png\n", {":2", "--headless"}},
             {"time 1\n", {"has no animation"}}})
        expect_one_sentence(play(script), 2, words);
    expect_one_sentence(run_lumel({"view", scene, "--headless"}), 2, {"--script"});
    expect_one_sentence(run_lumel({"view", scene}), 3, {"--headless"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"script.txt"});
}

TEST(View, ThePageOfTheManualHasEveryCommand)
{
    const std::string page = bytes_of(own_scene("../docs/view.md"));
    const std::string help = run_lumel({"view", "--help"}).out;
    const std::size_t begin = help.find("Commands of a script");
    ASSERT_NE(begin, std::string::npos);
    std::istringstream lines(help.substr(begin));
    std::string line;
    std::getline(lines, line);
    int commands = 0;
    while (std::getline(lines, line)) {
        if (line.size() < 3 || line[2] == ' ')
            continue;
        ++commands;
        const std::string word = line.substr(2, line.find(' ', 2) - 2);
        EXPECT_NE(page.find(fmt::format("`{}", word)), std::string::npos) << word;
    }
    EXPECT_GT(commands, 20);
}

}  // namespace
}  // namespace lumel::test
