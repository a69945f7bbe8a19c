// render --layers: an image of each lamp, which add up to that of all.

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/images/image_files.h"
#include "edited_scene.h"
#include "program.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kAskedError = 0.02;  ///< of "--error 2"

struct LayeredBox {
    bool dark = false;  ///< without the light of its ceiling
    const char* file = "glossy-cornell-box.gltf";
};

/// A box with a lit ceiling and these bulbs.
std::string box(const Workplace& place, const std::vector<std::string>& bulbs,
                const LayeredBox& wanted = {})
{
    EditedScene box(wanted.file);
    Json& json = box.json();
    for (Json& material : json["materials"])
        if (wanted.dark)
            material.erase("emissiveFactor");
    json["extensionsUsed"].push_back("KHR_lights_punctual");
    const auto position = [](const std::string& name) {
        return name == "left" ? Json{0.1, 0.4, 0.4} : Json{0.45, 0.1, 0.45};
    };
    Json lights = Json::array();
    for (const std::string& name : bulbs) {
        const Json color = name == "left" ? Json{1, 0.5, 0.2} : Json{0.3, 0.6, 1};
        lights.push_back({{"type", "point"}, {"name", name}, {"intensity", 0.3}, {"color", color}});
        const int node = box.push(
            "nodes", {{"name", name},
                      {"translation", position(name)},
                      {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
        json["scenes"][0]["nodes"].push_back(node);
    }
    if (!bulbs.empty())
        json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    return box.write(place);
}

Outcome render(const std::string& scene, const std::string& picture,
               const std::vector<std::string>& more = {"--layers"})
{
    std::vector<std::string> arguments = {"render",  scene, picture, "--size",   "64",
                                          "--width", "48",  "-q",    "--places", "4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lumel(arguments);
}

struct Difference {
    double mean = 0.0;  ///< of the absolute difference, relative to the mean of `wanted`
    double bias = 0.0;  ///< of the mean, relative likewise
};

Difference difference(const Image& image, const Image& wanted)
{
    double sum = 0.0, all = 0.0, absolute = 0.0;
    for (std::size_t v = 0; v < wanted.values.size(); ++v) {
        if (v % 4 == 3)
            continue;
        sum += double(image.values[v]);
        all += double(wanted.values[v]);
        absolute += std::abs(double(image.values[v]) - double(wanted.values[v]));
    }
    return {absolute / all, sum / all - 1.0};
}

Image sum_of(const Workplace& place, const std::vector<std::string>& files)
{
    Image sum;
    for (const std::string& file : files) {
        const Image image = read_exr(place.path(file));
        if (sum.values.empty())
            sum = Image(image.width, image.height, image.channels);
        for (std::size_t v = 0; v < sum.values.size(); ++v)
            sum.values[v] += image.values[v];
    }
    return sum;
}

const std::vector<std::string> kLamps = {"all-lamp-left.exr", "all-lamp-right.exr",
                                         "all-lamp-ceiling.exr"};

TEST(RenderLayers, AddUpToTheImageOfAllLamps)
{
    const Workplace place;
    const std::string scene = box(place, {"left", "right"});
    const Outcome outcome =
        render(scene, place.path("all.exr"), {"--layers", "--json", "--group", "ceiling=*light*"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::string> files = {"all.exr"};
    for (const std::string name : {"ceiling", "left", "right"})
        for (const std::string end : {".exr", ".png"})
            files.push_back("all-lamp-" + name + end);
    files.insert(files.end(), {"all-black.png", "all-white.png"});
    std::vector<std::string> told = Json::parse(outcome.out)["files"];
    std::ranges::sort(told);
    std::ranges::sort(files);
    EXPECT_EQ(told, files);
    for (const std::string& file : files)
        EXPECT_TRUE(fs::exists(place.path(file))) << file;
    EXPECT_LT(difference(sum_of(place, kLamps), read_exr(place.path("all.exr"))).mean, 1e-6);
}

TEST(RenderLayers, AddUpToTheImageByAnotherSolver)
{
    const Workplace place;
    const std::string scene = box(place, {"left", "right"}, {.file = "cornell-box.gltf"});
    ASSERT_EQ(render(scene, place.path("all.exr"), {"--layers", "--error", "2"}).code, 0);
    ASSERT_EQ(render(scene, place.path("other.exr"), {"--error", "2"}).code, 0);
    const Difference all =
        difference(read_exr(place.path("all.exr")), read_exr(place.path("other.exr")));
    EXPECT_LT(all.mean, kAskedError);
    EXPECT_LT(std::abs(all.bias), kAskedError / 2.0);
}

TEST(RenderLayers, AddUpToTheLightThatPathsFind)
{
    const Workplace place;
    const std::string scene =
        box(place, {"left", "right"}, {.dark = true, .file = "cornell-box.gltf"});
    ASSERT_EQ(render(scene, place.path("all.exr"), {"--layers", "--error", "2"}).code, 0);
    ASSERT_EQ(render(scene, place.path("truth.exr"), {"--paths", "256"}).code, 0);
    const Image sum = sum_of(place, {"all-lamp-left.exr", "all-lamp-right.exr"});
    EXPECT_LT(std::abs(difference(sum, read_exr(place.path("truth.exr"))).bias), kAskedError);
}

TEST(RenderLayers, AreTheImagesOfScenesWithOneLamp)
{
    const Workplace place, alone;
    const std::string scene = box(place, {"left", "right"});
    ASSERT_EQ(render(scene, place.path("all.exr"), {"--layers", "--error", "2"}).code, 0);
    const std::string with_left = box(alone, {"left"}, {.dark = true});
    ASSERT_EQ(render(with_left, alone.path("one.exr"), {"--layers", "--error", "2"}).code, 0);
    const Difference left =
        difference(read_exr(place.path("all-lamp-left.exr")), read_exr(alone.path("one.exr")));
    EXPECT_LT(left.mean, kAskedError);
    EXPECT_LT(std::abs(left.bias), kAskedError / 2.0);
}

TEST(RenderLayers, RefuseWhatTheyCannotShow)
{
    const Workplace place;
    const std::string scene = box(place, {"left"});
    const std::string picture = place.path("all.png");
    for (const char* option : {"--frames", "--paths", "--eye-shots"})
        expect_one_sentence(render(scene, picture, {"--layers", option, "8"}), 2,
                            {option, "cannot be used with --layers"});
    expect_one_sentence(render(scene, picture, {"--layers", "--sky-directions", "7"}), 2,
                        {"--sky-directions", "cannot be used with --layers"});
    expect_one_sentence(run_lumel({"render", scene, picture, "--layers", "--size", "64", "--width",
                                   "16384", "--places", "256", "-q"}),
                        2, {"--width 16384", "pixels"});
    expect_one_sentence(render(scene, picture, {"--layers", "--scheme", "paper"}), 2,
                        {"--scheme", "is not read with --layers"});
    expect_one_sentence(render(scene, picture, {"--group", "kitchen=lamp*"}), 2,
                        {"kitchen=lamp*", "fits no lamp", "\"left\""});
    expect_one_sentence(render(scene, picture, {"--group", "kitchen"}), 2, {"NAME=PATTERN"});
    const Outcome dark = render(box(place, {}, {.dark = true}), picture);
    EXPECT_EQ(dark.code, 2);
    EXPECT_NE(dark.err.find("has no lamp whose light can be kept apart"), std::string::npos)
        << dark.err;
    std::vector<std::string> bulbs;
    for (int k = 0; k < 65; ++k)
        bulbs.push_back("bulb " + std::to_string(k));
    expect_one_sentence(render(box(place, bulbs, {.dark = true}), picture), 2,
                        {"has 65 lamps", "--group"});
    EXPECT_FALSE(fs::exists(picture));
}

}  // namespace
}  // namespace lumel::test
