// The window of lumel view, on a display of its own, by a hand that xdotool moves.

#include "window_on_display.h"

namespace lumel::test {
namespace {

TEST_F(ViewWindow, ShowsThePictureOfItsScriptAndOfOneWithoutAWindow)
{
    // Within the box, so that something is in every pixel.
    const std::string script = "walk 0.9\nwait\npicture a.png\n";
    Window window(display(), script);
    ASSERT_TRUE(window.is_there());
    display().hand("mousemove 799 599");
    ASSERT_TRUE(window.has_written("a.png"));
    const Picture written = read_picture(window.place.path("out/a.png"));
    EXPECT_TRUE(window.wait_until("another picture on the display", [&] {
        return difference(display().seen(written.width, written.height), written).most == 0;
    })) << difference(display().seen(written.width, written.height), written).most;
    window.close();

    const Workplace place;
    const Outcome headless =
        run_lumel({"view", own_scene("cornell-box.gltf"), "--script", place.file("s.txt", script),
                   "--folder", place.path("out"), "--size", "64", "--width", "240", "--headless"});
    ASSERT_EQ(headless.code, 0) << headless.err;
    EXPECT_LE(difference(read_picture(place.path("out/a.png")), written).most, 1);
}

TEST_F(ViewWindow, AClickPicksWhatIsUnderTheMouse)
{
    Window window(display(), "wait\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    EXPECT_EQ(Json::parse(bytes_of(window.place.path("out/ready.json")))["picked"], nullptr);
    window.hand("mousemove 150 170");
    window.hand("click 1");
    const Json state = window.close();
    EXPECT_EQ(state["picked"]["name"], "short block");
    EXPECT_EQ(state["pixel"]["at"], Json::array({150, 170}));
}

TEST_F(ViewWindow, AKeyWalksToWhereTheCameraLooks)
{
    Window window(display(), "wait\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const Json before = Json::parse(bytes_of(window.place.path("out/ready.json")))["camera"];
    window.hand("key w");
    const Json after = window.close()["camera"];
    // It looks along +z.
    EXPECT_GT(after["eye"][2].get<double>(), before["eye"][2].get<double>() + 0.005);
    EXPECT_NEAR(after["eye"][0].get<double>(), before["eye"][0].get<double>(), 1e-5);
    EXPECT_NEAR(after["eye"][1].get<double>(), before["eye"][1].get<double>(), 1e-5);
    EXPECT_EQ(after["forward"], before["forward"]);
}

TEST_F(ViewWindow, AKeyWithControlDoesNotWalk)
{
    Window window(display(), "wait\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const Json before = Json::parse(bytes_of(window.place.path("out/ready.json")))["camera"];
    // The key is down for longer than Ctrl.
    for (const char* does : {"keydown ctrl keydown d keyup ctrl", "keyup d"})
        window.hand(does);
    EXPECT_EQ(window.close()["camera"]["eye"], before["eye"]);
}

TEST_F(ViewWindow, WhatIsPickedIsDraggedAlongTheFloor)
{
    Window window(display(), "wait\npick \"short block\"\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const Json before =
        Json::parse(bytes_of(window.place.path("out/ready.json")))["picked"]["place"];
    for (const char* does : {"mousemove 150 170", "mousedown 1", "mousemove 160 172",
                             "mousemove 180 175", "mouseup 1"})
        window.hand(does);
    const Json state = window.close();
    ASSERT_EQ(state["picked"]["name"], "short block");
    const Json after = state["picked"]["place"];
    // The camera looks along +z with +x to its left.
    EXPECT_LT(after[0].get<double>(), before[0].get<double>() - 0.02);
    EXPECT_NEAR(after[1].get<double>(), before[1].get<double>(), 1e-5);
    EXPECT_GT(state["light"]["links_traced_again"], 0);
}

TEST_F(ViewWindow, KeysPickNothingDeleteAndChangeTheMode)
{
    Window window(display(), "wait\npick \"short block\"\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    for (const char* does : {"key Delete", "mousemove 150 170", "click 1", "key m"})
        window.hand(does);
    const Json state = window.close();
    EXPECT_NE(state["picked"]["name"], "short block");
    EXPECT_EQ(state["mode"], "irradiance");
}

TEST_F(ViewWindow, ASmallWindowIsAllPicture)
{
    Window window(display(), "wait\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    window.hand("search --name lumel windowsize --sync 230 170");
    const Picture picture = window.shoot();
    EXPECT_EQ(picture.width, 230);
    EXPECT_EQ(picture.height, 170);
    const Json state = window.close();
    EXPECT_EQ(state["picture"]["width"], 230);
}

TEST_F(ViewWindow, AScriptMayCloseItAndWriteWhatItShows)
{
    Window window(display(), "walk 0.9\nwait\npicture a.png\nwindow w.png\nquit\npicture b.png\n");
    const Outcome outcome = window.end();
    const Json report = Json::parse(outcome.out, nullptr, false);
    EXPECT_EQ(report["files"], Json::array({"a.png", "w.png"}));
    const Picture picture = read_picture(window.place.path("out/a.png")),
                  all = read_picture(window.place.path("out/w.png"));
    ASSERT_GT(all.width, picture.width);
    ASSERT_EQ(all.height, picture.height);
    int wrong = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            wrong += all.at(x, y) != picture.at(x, y);
    EXPECT_EQ(wrong, 0);
    // The panel has letters.
    Picture panel{all.width - picture.width, all.height, {}};
    for (int y = 0; y < all.height; ++y)
        for (int x = picture.width; x < all.width; ++x)
            for (const int channel : all.at(x, y))
                panel.rgb.push_back(static_cast<unsigned char>(channel));
    EXPECT_GT(panel.most(), 200);
}

TEST_F(ViewWindow, LightThatIsSolvedAnewKeepsWhatWasDone)
{
    Window window(display(),
                  "exposure 2\npick \"short block\"\nmove 0.1,0,0\nturn 20\npaint 0,0.5,1\n"
                  "pick \"tall block\"\ndelete\nlamp light 0.5,0.4,0.3\n"
                  "pick 60,200\nwait\nstate before.json\n");
    ASSERT_TRUE(window.is_there());
    display().hand("mousemove 799 599");
    ASSERT_TRUE(window.has_written("before.json"));
    const Json before = Json::parse(bytes_of(window.place.path("out/before.json")));
    ASSERT_NE(before["picked"], nullptr);
    const Picture one = window.shoot();
    window.hand("key n");
    // Moves are followed again, and then the picture is the one of before.
    EXPECT_TRUE(window.wait_until("another picture after the key N",
                                  [&] { return difference(one, window.shoot()).mean < 0.1; }));
    const Json after = window.close();
    EXPECT_EQ(after["picked"], nullptr);  // it is another session
    EXPECT_EQ(after["lamps"], before["lamps"]);
    EXPECT_EQ(after["light"]["lumels"], before["light"]["lumels"]);
    EXPECT_EQ(after["exposure"]["automatic"], false);
}

TEST_F(ViewWindow, TheLegendOfFalseColoursHidesNothing)
{
    Window window(display(), "walk 0.9\nwait\nstate s.json\nmode irradiance\npicture a.png\n"
                             "window w.png\nmode lit\nwindow lit.png\nquit\n");
    window.end();
    const auto read = [&](const std::string& name) {
        return read_picture(window.place.path("out/" + name));
    };
    const Picture picture = read("a.png"), all = read("w.png"), lit = read("lit.png");
    const int width =
        Json::parse(bytes_of(window.place.path("out/s.json")))["picture"]["width"].get<int>();
    ASSERT_LT(width, picture.width);
    int wrong = 0;
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < width; ++x)
            wrong += all.at(x, y) != picture.at(x, y);
    EXPECT_EQ(wrong, 0);
    // It is in the panel: yellow, which nothing else there is.
    const auto yellow = [&](const Picture& seen) {
        int count = 0;
        for (int y = 0; y < seen.height; ++y)
            for (int x = width; x < seen.width; ++x) {
                const Colour colour = seen.at(x, y);
                count += colour[0] > 150 && colour[1] > 200 && colour[2] < 80;
            }
        return count;
    };
    EXPECT_GT(yellow(all), 100);
    EXPECT_EQ(yellow(lit), 0);
}

TEST_F(ViewWindow, ALineThatIsWrongEndsItInOneSentence)
{
    const Workplace place;
    const Outcome outcome =
        run_lumel({"view", own_scene("cornell-box.gltf"), "--script",
                   place.file("s.txt", "picture a.png\npick nothing\n"), "--folder",
                   place.path("out"), "--size", "32", "--width", "200"},
                  {.environment = {"DISPLAY=" + display().name()}});
    expect_one_sentence(outcome, 2, {":2", "nothing"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"s.txt"});
}

}  // namespace
}  // namespace lumel::test
