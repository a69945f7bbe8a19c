// Animations whose light follows over links that are kept.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>

#include "edited_scene.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

/// As suits the dark room once the door is open.
const std::string kExposure = "2";

/// Mean and largest of a picture's colours, 0 to 255.
struct Brightness {
    double mean = 0.0;
    int most = 0;
};

Brightness brightness(const std::string& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << path;
    image.format = PNG_FORMAT_RGB;
    std::vector<unsigned char> rgb(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr));
    Brightness result;
    for (const unsigned char one : rgb) {
        result.mean += double(one) / double(rgb.size());
        result.most = std::max(result.most, int(one));
    }
    return result;
}

std::vector<std::string> play(const std::string& scene, const std::string& folder,
                              const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {"play",  scene,     folder, "--solver",
                                          "links", "--width", "32",   "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// Three frames, one a second.
Outcome play_seconds(const std::string& scene, const std::string& folder,
                     const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = play(scene, folder, {"--frames", "3", "--fps", "1"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lumel(arguments);
}

/// The rows of frames, or none with a failure.
Json rows_of(const Outcome& outcome)
{
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json report = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(report.is_discarded()) << outcome.out;
    return report.is_discarded() ? Json::array() : report["frames"];
}

/// The lamp of the Cornell box burns for a second.
std::string lamp_goes_out(const Workplace& place)
{
    EditedScene scene("cornell-box.gltf");
    const auto& materials = scene.json()["materials"];
    std::size_t lamp = 0;
    while (materials[lamp]["name"] != "light")
        ++lamp;
    const Json strength =
        materials[lamp]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
    scene.json()["extensionsUsed"].push_back("KHR_animation_pointer");
    scene.animate({{"path", "pointer"},
                   {"extensions",
                    {{"KHR_animation_pointer",
                      {{"pointer", "/materials/" + std::to_string(lamp) +
                                       "/extensions/KHR_materials_emissive_strength/"
                                       "emissiveStrength"}}}}}},
                  {0.0f, 1.0f, 2.0f}, {strength, 0.0f, strength}, "SCALAR", 1, "STEP");
    return scene.write(place);
}

/// A door between two rooms, of which one has the lamp and the other the camera, slides open.
std::string door_opens(const Workplace& place)
{
    EditedScene scene("two-rooms.gltf");
    const int door = scene.add_block("door", {2.3f, -0.3f, 2.95f}, {3.8f, 2.4f, 3.1f});
    scene.animate({{"node", door}, {"path", "translation"}}, {0.0f, 1.0f, 2.0f},
                  {0, 0, 0, 0, 0, 0, -1.6f, 0, 0}, "VEC3", 3, "LINEAR");
    return scene.write(place);
}

TEST(PlayLinks, WritesAPictureAndARowForEachFrame)
{
    const Workplace place;
    const Json rows = rows_of(run_lumel(play(own_scene("turning-box.gltf"), place.path("out"),
                                             {"--frames", "3", "--fps", "12", "--size", "64"})));
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_EQ(rows[k]["file"], "frame-000" + std::to_string(k + 1) + ".png");
        EXPECT_GT(brightness(place.path("out/frame-000" + std::to_string(k + 1) + ".png")).mean,
                  30.0);
        EXPECT_FALSE(rows[k].contains("hemicubes"));
        EXPECT_LE(rows[k]["residual"], 2e-4);
        EXPECT_EQ(rows[k]["at_rest"], true);
        EXPECT_GT(rows[k]["estimated_error"], 0.0);
        EXPECT_LE(rows[k]["estimated_error"], 0.02);
        EXPECT_GT(rows[k]["sweeps"], 0);
    }
    EXPECT_EQ(rows[0]["links"], 0);
    EXPECT_GT(rows[1]["links"], 0);
    EXPECT_GT(rows[1]["direct"], 0.0);
    EXPECT_LT(rows[1]["direct"], 1.0);
    EXPECT_NE(bytes_of(place.path("out/frame-0001.png")),
              bytes_of(place.path("out/frame-0002.png")));
}

TEST(PlayLinks, LampThatGoesOutLeavesDarknessInTheSameFrame)
{
    const Workplace place;
    const std::string scene = lamp_goes_out(place);
    const Json rows = rows_of(play_seconds(scene, place.path("out"), {"--size", "64"}));
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_GT(brightness(place.path("out/frame-0001.png")).mean, 30.0);
    EXPECT_EQ(brightness(place.path("out/frame-0002.png")).most, 0);
    EXPECT_EQ(rows[1]["links"], 0);
    EXPECT_EQ(rows[1]["at_rest"], true);
    EXPECT_NEAR(brightness(place.path("out/frame-0003.png")).mean,
                brightness(place.path("out/frame-0001.png")).mean, 0.5);
}

TEST(PlayLinks, DoorThatOpensLightsTheRoomBehind)
{
    const Workplace place;
    const std::string scene = door_opens(place);
    const Json rows =
        rows_of(play_seconds(scene, place.path("out"), {"--size", "128", "--exposure", kExposure}));
    ASSERT_EQ(rows.size(), 3u);
    // At the frame of the door a little light of the other room is in lumels that both see.
    EXPECT_LT(brightness(place.path("out/frame-0001.png")).mean, 0.5);
    EXPECT_EQ(rows[1]["links"], 0) << "the door rests for a second";
    EXPECT_LT(brightness(place.path("out/frame-0002.png")).mean, 0.5);
    EXPECT_GT(rows[2]["links"], 0);
    EXPECT_GT(brightness(place.path("out/frame-0003.png")).mean, 80.0);
}

TEST(PlayLinks, WithABudgetLightLagsAndIsRightOnceAtRest)
{
    const Workplace place;
    const std::string scene = door_opens(place);
    const Json hurried = rows_of(run_lumel(play(scene, place.path("hurried"),
                                                {"--frames", "250", "--fps", "50", "--size", "128",
                                                 "--exposure", kExposure, "--budget", "3"})));
    ASSERT_EQ(hurried.size(), 250u);
    const auto lags = std::count_if(hurried.begin(), hurried.end(),
                                    [](const Json& row) { return row["at_rest"] == false; });
    EXPECT_GT(lags, 10);
    // After two seconds the door stands still.
    EXPECT_EQ(hurried[249]["at_rest"], true);
    EXPECT_FALSE(hurried[249].contains("estimated_error"));
    const Json whole = rows_of(play_seconds(
        scene, place.path("whole"), {"--size", "128", "--exposure", kExposure, "--error", "0"}));
    ASSERT_EQ(whole.size(), 3u);
    EXPECT_NEAR(brightness(place.path("hurried/frame-0250.png")).mean,
                brightness(place.path("whole/frame-0003.png")).mean, 0.1);
}

TEST(PlayLinks, RefusesWhatItDoesNotRead)
{
    const Workplace place;
    const std::string scene = own_scene("turning-box.gltf"), out = place.path("out");
    for (const std::vector<std::string>& given : {std::vector<std::string>{"--leak", "0.1"},
                                                  {"--redistribution", "cross"},
                                                  {"--sampling", "centre"}})
        expect_one_sentence(run_lumel(play(scene, out, given)), 2, {given[0], "--solver links"});
    expect_one_sentence(run_lumel(play(scene, out, {"--links", "50"})), 2, {"--links", "50", "64"});
    expect_one_sentence(run_lumel(play(scene, out, {"--error", "1", "--budget", "5"})), 2,
                        {"--error", "--budget"});
    expect_one_sentence(run_lumel({"play", scene, out, "--links", "16"}), 2,
                        {"--links", "--solver progressive"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lumel::test
