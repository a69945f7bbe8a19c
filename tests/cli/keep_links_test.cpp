// Over links that a bake has kept, a changed scene is lit as by a new bake of it, in every bit.

#include <cmath>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/images/image_files.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;
using Edit = std::function<void(Json&)>;

constexpr const char* kKeptSide = "64";  // of the atlas [texels]
constexpr const char* kRays = "24";      // of a lumel
constexpr int kSkyWidth = 32, kSkyHeight = 16;

const Edit kAsItIs = [](Json&) {};

Json& named_in(Json& list, const std::string& name)
{
    for (Json& entry : list)
        if (entry.value("name", "") == name)
            return entry;
    throw std::runtime_error("nothing is called " + name);
}

/// The Cornell box with a lamp in it, and bakes of it under a sky with a bright part.
class KeptBox {
public:
    KeptBox()
    {
        Image sky(kSkyWidth, kSkyHeight, 3);
        for (std::size_t k = 0; k < sky.values.size(); ++k)
            sky.values[k] = 1.0f + float(k % 7);
        sky.at(20, 3)[0] = 2000.0f;
        write_exr(place.path("sky.exr"), sky, Precision::float32, {});
    }

    /// Bakes the scene as `edit` leaves it into a folder of that name.
    std::string bake(const std::string& name, const Edit& edit = kAsItIs,
                     const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments = {
            "bake",    scene(edit),    place.path(name), "--sky", place.path("sky.exr"), "--size",
            kKeptSide, "--keep-links", "--links",        kRays,   "--preview-width",     "0",
            "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return place.path(name);
    }

    Outcome relight(const std::string& folder, const Json& states) const
    {
        return run_lumel({"relight", folder, place.file("states.json", states.dump()), "--json"});
    }

    std::string scene(const Edit& edit) const
    {
        Json scene = Json::parse(bytes_of(own_scene("cornell-box.gltf")));
        scene["extensionsUsed"].push_back("KHR_lights_punctual");
        scene["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"name", "bulb"}, {"color", {1.0, 0.75, 0.5}}, {"intensity", 0.1}}};
        scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
        scene["nodes"].push_back({{"name", "bulb"},
                                  {"translation", {0.45, 0.3, 0.1}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        edit(scene);
        return place.file("edited.gltf", scene.dump());
    }

    const Workplace place;
};

/// Are two maps the same in every bit?
void expect_equal(const std::string& a, const std::string& b)
{
    const Image one = read_exr(a), other = read_exr(b);
    ASSERT_FALSE(one.values.empty());
    std::size_t different = 0;
    for (std::size_t k = 0; k < one.values.size(); ++k)
        different += one.values[k] != other.values[k];
    EXPECT_EQ(one.values.size(), other.values.size());
    EXPECT_EQ(different, 0u) << a << " and " << b;
}

/// A state follows only rays whose first hit is near.
void expect_few_traced(const Json& report)
{
    const double all = report["links"]["rays"].get<double>() *
                       report["links"]["lumels"].get<double>() * double(report["states"].size());
    EXPECT_LT(4 * report["links"]["traced_again"].get<double>(), all);
}

void dim_lamp(Json& scene)
{
    for (Json& channel : named_in(scene["materials"], "light")["emissiveFactor"])
        channel = 0.25 * channel.get<double>();
}

TEST(KeepLinks, RelightIsANewBakeOfTheChangedScene)
{
    const KeptBox box;
    const std::string folder = box.bake("out");
    EXPECT_TRUE(std::filesystem::exists(folder + "/scene.lumellinks"));
    const Json baked = Json::parse(bytes_of(folder + "/report.json"))["solution"];
    EXPECT_EQ(baked["shots"], std::stoi(kRays));
    EXPECT_EQ(baked["convergence"].size(), 1u);
    EXPECT_EQ(baked["convergence"][0]["error"], baked["estimated_error"]);
    const Outcome outcome = box.relight(
        folder, {{"states",
                  {{{"name", "as baked"}},
                   {{"name", "lamps"},
                    {"lights",
                     {{"light", 0.25},
                      {"bulb", {{"position", {0.1, 0.4, 0.3}}, {"factor", {0.5, 1, 2}}}}}}},
                   {{"name", "sky"}, {"lights", {{"sky", {{"turn", 90}, {"factor", 0.5}}}}}}}}});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json report = Json::parse(outcome.out);
    expect_few_traced(report);
    EXPECT_EQ(report["states"].size(), 3u);
    EXPECT_EQ(report["links"]["sources"], Json({"sky", "bulb", "light"}));
    expect_equal(folder + "/states/as baked.exr", folder + "/lightmap.exr");
    const std::string lamps = box.bake("lamps", [](Json& scene) {
        dim_lamp(scene);
        named_in(scene["nodes"], "bulb")["translation"] = {0.1, 0.4, 0.3};
        scene["extensions"]["KHR_lights_punctual"]["lights"][0]["color"] = {0.5, 0.75, 1.0};
    });
    expect_equal(folder + "/states/lamps.exr", lamps + "/lightmap.exr");
    const auto expect_error = [&](std::size_t state, const std::string& bake) {
        const Json solution = Json::parse(bytes_of(bake + "/report.json"))["solution"];
        for (const char* error : {"estimated_error", "estimated_dark_error"}) {
            EXPECT_GT(solution[error], 0.0);
            EXPECT_EQ(report["states"][state][error], solution[error]) << bake;
        }
    };
    expect_error(0, folder);
    expect_error(1, lamps);
    const std::string sky =
        box.bake("sky", kAsItIs, {"--sky-rotation", "90", "--sky-scale", "0.5"});
    expect_equal(folder + "/states/sky.exr", sky + "/lightmap.exr");
    expect_error(2, sky);
}

// Lumels inside of the blocks are buried by both.
TEST(KeepLinks, ABoxOfTwoSidedBlocksIsRelitAsItWasBaked)
{
    const KeptBox box;
    const std::string folder = box.bake("out", [](Json& scene) {
        for (Json& material : scene["materials"])
            material["doubleSided"] = true;
    });
    const Outcome outcome = box.relight(folder, {{"states", {{{"name", "as baked"}}}}});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_few_traced(Json::parse(outcome.out));
    expect_equal(folder + "/states/as baked.exr", folder + "/lightmap.exr");
}

/// The report's row of an update.
Json update(const KeptBox& box, const std::string& folder, const Edit& edit)
{
    const Outcome outcome =
        run_lumel({"update", folder, box.scene(edit), "--preview-width", "0", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["update"];
}

TEST(KeepLinks, UpdateOfPaintAndLampsIsANewBakeOfTheEditedScene)
{
    const KeptBox box;
    const std::string folder = box.bake("out");
    const Edit edit = [](Json& scene) {
        named_in(scene["materials"], "red")["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2,
                                                                                          0.7, 1.0};
        dim_lamp(scene);
    };
    const Json row = update(box, folder, edit);
    EXPECT_EQ(row["recoloured"], 2);
    EXPECT_LT(4 * row["rays"].get<double>(), row["links"].get<double>());
    const std::string fresh = box.bake("fresh", edit);
    expect_equal(folder + "/lightmap.exr", fresh + "/lightmap.exr");
    EXPECT_TRUE(bytes_of(folder + "/scene.lumellinks") == bytes_of(fresh + "/scene.lumellinks"));
    const auto error = [](const std::string& bake) {
        return Json::parse(bytes_of(bake + "/report.json"))["solution"]["estimated_error"];
    };
    EXPECT_EQ(error(folder), error(fresh));
    EXPECT_NE(row["error_before"], error(fresh));

    // What was updated is lit anew as what was baked.
    const Outcome again = box.relight(folder, {{"states", {{{"name", "same"}}}}});
    ASSERT_EQ(again.code, 0) << again.err;
    expect_few_traced(Json::parse(again.out));
    expect_equal(folder + "/states/same.exr", fresh + "/lightmap.exr");
}

// A new bake may pack a thing that moved otherwise, so the bake to compare with is the first.
TEST(KeepLinks, UpdateOfAThingMovedToWhereABakeHasItIsThatBake)
{
    const KeptBox box;
    const std::string folder = box.bake("out"), map = folder + "/lightmap.exr",
                      links = bytes_of(folder + "/scene.lumellinks"),
                      before = box.place.file("before.exr", bytes_of(map));
    const auto few = [&](const Json& row) {
        EXPECT_EQ(row["moved"], 1);
        EXPECT_GT(row["rays"], 0);
        EXPECT_LT(2 * row["rays"].get<double>(), row["links"].get<double>());
    };
    few(update(box, folder, [](Json& scene) {
        named_in(scene["nodes"], "short block")["translation"] = {-0.05, 0.0, 0.08};
    }));
    EXPECT_NE(read_exr(map).values, read_exr(before).values);
    EXPECT_FALSE(bytes_of(folder + "/scene.lumellinks") == links);
    few(update(box, folder, kAsItIs));
    expect_equal(map, before);
    EXPECT_TRUE(bytes_of(folder + "/scene.lumellinks") == links);
}

TEST(KeepLinks, UpdateOfAThingThatAppearsOrGoesTracesFewLinksAndCanBeLitAnew)
{
    const KeptBox box;
    const std::string folder = box.bake("out");
    const Edit without = [](Json& scene) {
        Json& nodes = scene["scenes"][0]["nodes"];
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (scene["nodes"][nodes[n].get<std::size_t>()].value("name", "") == "short block") {
                nodes.erase(n);
                return;
            }
    };
    std::vector<int> widths;
    for (const Edit& edit : {without, kAsItIs}) {
        const Json row = update(box, folder, edit);
        const Json sizes = Json::parse(bytes_of(folder + "/report.json"))["sizes"];
        EXPECT_GT(row["rays"], 0);
        if (sizes["atlas_width"] == std::stoi(kKeptSide))
            EXPECT_LT(2 * row["rays"].get<double>(), row["links"].get<double>());
        else
            EXPECT_EQ(row["rays"], row["links"]);  // the map grew: places are rounded otherwise
        widths.push_back(sizes["atlas_width"]);
        const Outcome again = box.relight(folder, {{"states", {{{"name", "same"}}}}});
        ASSERT_EQ(again.code, 0) << again.err;
        expect_few_traced(Json::parse(again.out));
        expect_equal(folder + "/states/same.exr", folder + "/lightmap.exr");
    }
    EXPECT_EQ(widths.front(), std::stoi(kKeptSide));
}

// Rays by need: sweeps that went on from round to round leave other residuals than those begun
// anew.
TEST(KeepLinks, RelightOfABakeToAnErrorIsThatBake)
{
    constexpr double kResidual = 2e-3;  // of the mean light
    const KeptBox box;
    const std::string folder = box.place.path("out");
    const Outcome outcome =
        run_lumel({"bake", box.scene(kAsItIs), folder, "--size", kKeptSide, "--keep-links",
                   "--error", "2", "--preview-width", "0", "-q"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json solution = Json::parse(bytes_of(folder + "/report.json"))["solution"];
    EXPECT_LE(solution["estimated_error"].get<double>(), 0.02);
    EXPECT_GT(solution["shots"], std::stoi(kRays));
    const Outcome relit = box.relight(folder, {{"states", {{{"name", "same"}}}}});
    ASSERT_EQ(relit.code, 0) << relit.err;
    EXPECT_LE(Json::parse(relit.out)["states"][0]["estimated_error"].get<double>(), 0.02);
    const Image baked = read_exr(folder + "/lightmap.exr"),
                same = read_exr(folder + "/states/same.exr");
    double squares = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < baked.values.size(); ++k) {
        squares += std::pow(double(baked.values[k]) - double(same.values[k]), 2.0);
        sum += double(baked.values[k]);
    }
    const double mean = sum / double(baked.values.size());
    EXPECT_GT(mean, 0.0);
    EXPECT_LE(std::sqrt(squares / double(baked.values.size())), kResidual * mean);
}

// The light after the edit is noisier than that which the bake reached with its rays.
TEST(KeepLinks, AnUpdateSendsNoMoreRaysThanItsBakeMay)
{
    constexpr int kMost = 48;
    const KeptBox box;
    const std::string folder = box.place.path("out");
    const Outcome outcome =
        run_lumel({"bake", box.scene(kAsItIs), folder, "--sky", box.place.path("sky.exr"), "--size",
                   kKeptSide, "--keep-links", "--quality", "fine", "--shots", std::to_string(kMost),
                   "--preview-width", "0", "-q"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    update(box, folder, [](Json& scene) {
        named_in(scene["materials"], "light")["emissiveFactor"] = {0, 0, 0};
    });
    const Json solution = Json::parse(bytes_of(folder + "/report.json"))["solution"];
    EXPECT_GT(solution["shots"], 0);
    EXPECT_LE(solution["shots"], kMost);
}

TEST(Links, AreAsManyAsGiven)
{
    const Workplace place;
    const std::string out = place.path("out");
    const Outcome baked = run_lumel({"bake", own_scene("cornell-box.gltf"), out, "--size", "16",
                                     "--links", "384", "--preview-width", "0", "-q"});
    ASSERT_EQ(baked.code, 0) << baked.err;
    EXPECT_EQ(Json::parse(bytes_of(out + "/report.json"))["solution"]["shots"], 384);
}

TEST(KeepLinks, RefusesWhatItCannotKeepOrLight)
{
    const KeptBox box;
    const std::string scene = own_scene("cornell-box.gltf"), out = box.place.path("none");
    const auto refused = [&](const std::vector<std::string>& more,
                             const std::vector<std::string>& words) {
        std::vector<std::string> arguments = {"bake", scene, out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_one_sentence(run_lumel(arguments), 2, words);
        EXPECT_FALSE(std::filesystem::exists(out));
    };
    refused({"--keep-links", "--solver", "matrix"}, {"--keep-links", "links"});
    refused({"--links", "24", "--error", "1"}, {"--error", "--links"});
    refused({"--links", "24", "--solver", "gather"}, {"--links", "--solver links"});
    refused({"--links", "20"}, {"--links", "multiple of 3"});

    const std::string folder = box.bake("out");
    const auto fails = [&](const Json& lights) {
        return box.relight(folder, {{"states", {{{"name", "a"}, {"lights", lights}}}}});
    };
    expect_one_sentence(fails({{"lamp", 1}}), 2, {"states.json", "\"a\"", "\"lamp\"", "\"bulb\""});
    expect_one_sentence(fails({{"bulb", {{"turn", 10}}}}), 2, {"\"bulb\"", "turn"});
    expect_one_sentence(fails({{"sky", {{"position", {1, 2, 3}}}}}), 2, {"\"sky\"", "turn"});
    expect_one_sentence(fails({{"light", {{"position", {1, 2, 3}}}}}), 2,
                        {"\"light\"", "not a lamp"});

    const std::string links = bytes_of(folder + "/scene.lumellinks");
    const auto expect_refused = [&](const std::string& bytes,
                                    const std::vector<std::string>& words) {
        box.place.file("out/scene.lumellinks", bytes);
        expect_one_sentence(fails(Json::object()), 2, words);
        expect_one_sentence(run_lumel({"update", folder, scene}), 2, words);
    };
    expect_refused(links.substr(0, links.size() / 2), {"scene.lumellinks", "damaged"});
    const std::string other = box.bake("other", dim_lamp);
    expect_refused(bytes_of(other + "/scene.lumellinks"), {"scene.lumellinks", "another scene"});
    EXPECT_FALSE(std::filesystem::exists(folder + "/states"));
}

TEST(KeepLinks, ABakeThatKeepsNoneRemovesThoseOfAnother)
{
    const KeptBox box;
    const std::string folder = box.bake("out");
    const Outcome outcome = run_lumel({"bake", own_scene("cornell-box.gltf"), folder, "--size",
                                       "16", "--shots", "16", "--preview-width", "0", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder + "/scene.lumellinks"));
}

}  // namespace
}  // namespace lumel::test
