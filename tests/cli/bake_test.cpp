// The main job from outside: files, JSON, silence, interruption, exit codes.

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compared.h"
#include "png_picture.h"
#include "program.h"

namespace lumel::test {
namespace {

const std::vector<std::string> kResults = {"lightmap.exr", "lightmap.png",    "preview.png",
                                           "report.json",  "scene-baked.glb", "scene.glb",
                                           "solution.exr"};

std::vector<std::string> inside(const std::string& folder)
{
    std::vector<std::string> paths = {folder};
    for (const std::string& name : kResults)
        paths.push_back(folder + "/" + name);
    return paths;
}

std::vector<std::string> small_bake(const std::string& folder, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {
        "bake", own_scene("cornell-box.gltf"), folder, "--size", "32", "--preview-width", "64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Bake, WritesAllItsFilesAndNothingElse)
{
    const Workplace place;
    const Outcome bake = run_lumel(small_bake(place.path("out"), {"--shots", "64"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    EXPECT_EQ(place.listing(), inside("out"));
    EXPECT_EQ(bytes_of(place.path("out/lightmap.exr")).substr(0, 4), "\x76\x2f\x31\x01");
    EXPECT_EQ(bytes_of(place.path("out/preview.png")).substr(1, 3), "PNG");
    EXPECT_EQ(bytes_of(place.path("out/scene.glb")).substr(0, 4), "glTF");
    EXPECT_EQ(bytes_of(place.path("out/scene-baked.glb")).substr(0, 4), "glTF");
}

TEST(Bake, PrintsTheReportItWritesAsJson)
{
    const Workplace place;
    const Outcome bake = run_lumel(small_bake(place.path("out"), {"--shots", "64", "--json"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    const auto printed = nlohmann::json::parse(bake.out, nullptr, false);
    ASSERT_FALSE(printed.is_discarded()) << bake.out;
    EXPECT_EQ(printed, nlohmann::json::parse(bytes_of(place.path("out/report.json"))));
}

nlohmann::json json_of_glb(const std::string& file)
{
    constexpr std::size_t kJsonAt = 20;  // after two headers
    return nlohmann::json::parse(file.substr(kJsonAt, file.find("BIN", kJsonAt) - 4 - kJsonAt));
}

TEST(Bake, ReportAndSceneStateTheExposureOfThePictures)
{
    const Workplace place;
    const Outcome bake =
        run_lumel(small_bake(place.path("out"), {"--shots", "64", "--json", "--lightmap-format",
                                                 "none", "--compress", "meshopt"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    const auto report = nlohmann::json::parse(bake.out);
    const auto scene = json_of_glb(bytes_of(place.path("out/scene.glb")));
    const double exposure = scene["asset"]["extras"]["lumel"]["exposure"];
    EXPECT_GT(exposure, 0.0);
    EXPECT_NEAR(report["solution"]["exposure"], exposure, 1e-6 * exposure);
    EXPECT_FALSE(scene.contains("images"));
    EXPECT_EQ(report["settings"]["lightmap-format"], "none");
    EXPECT_EQ(report["settings"]["compress"], "meshopt");
    EXPECT_FALSE(scene.contains("extensionsRequired"));  // its few triangles would take more
}

TEST(Bake, TakesAnExposureThatItsCorrectionsKeep)
{
    const Workplace place;
    const float given = 0.02f;
    ASSERT_EQ(
        run_lumel(small_bake(place.path("out"), {"--shots", "12", "--exposure", "0.02"})).code, 0);
    const auto exposure_of = [](const std::string& folder) {
        const auto scene = json_of_glb(bytes_of(folder + "/scene.glb"));
        return double(scene["asset"]["extras"]["lumel"]["exposure"]);
    };
    // A white surface of irradiance H sends H / pi.
    const double of_irradiance = double(given) / std::numbers::pi;
    EXPECT_NEAR(exposure_of(place.path("out")), of_irradiance, 1e-6 * of_irradiance);
    const Outcome update =
        run_lumel({"update", place.path("out"), own_scene("cornell-box.gltf"), "--sky", "5,5,5"});
    ASSERT_EQ(update.code, 0) << update.err;
    EXPECT_NEAR(exposure_of(place.path("out")), of_irradiance, 1e-6 * of_irradiance);
    const Outcome refused = run_lumel(small_bake(place.path("bad"), {"--exposure", "0"}));
    EXPECT_NE(refused.code, 0);
    EXPECT_NE(refused.err.find("--exposure"), std::string::npos) << refused.err;
}

TEST(Bake, EndsWithTheFilesForViewers)
{
    const Workplace place;
    const Outcome bake = run_lumel(small_bake(place.path("out"), {"--shots", "6"}));
    const std::string last = bake.out.substr(bake.out.rfind('\n', bake.out.size() - 2) + 1);
    for (const char* file : {"out/scene-baked.glb", "out/scene.glb"})
        EXPECT_NE(last.find(file), std::string::npos) << bake.out;
}

TEST(Bake, TellsItsProgressToPrograms)
{
    const Workplace place;
    const Outcome bake = run_lumel(
        small_bake(place.path("out"), {"--shots", "24", "--quiet", "--progress", "json"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    std::istringstream lines(bake.err);
    std::set<std::string> stages;
    std::string line;
    while (std::getline(lines, line)) {
        const auto now = nlohmann::json::parse(line, nullptr, false);
        ASSERT_TRUE(now.is_object()) << line;
        stages.insert(now.value("stage", ""));
        EXPECT_GE(now.value("fraction", -1.0), 0.0) << line;
        EXPECT_LE(now.value("fraction", 2.0), 1.0) << line;
    }
    for (const char* stage : {"reading", "charts", "solving", "writing"})
        EXPECT_TRUE(stages.contains(stage)) << stage;
}

Picture preview_of(const std::string& scene, const std::vector<std::string>& options)
{
    const Workplace place;
    std::vector<std::string> bake = {"bake",
                                     own_scene(scene),
                                     place.path("out"),
                                     "--size",
                                     "128",
                                     "--preview-width",
                                     "256",
                                     "--error",
                                     "10"};
    bake.insert(bake.end(), options.begin(), options.end());
    const Outcome outcome = run_lumel(bake);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_picture(place.path("out/preview.png"));
}

/// Share of pixels with all channels in [first, last].
double share(const Picture& picture, int first, int last)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        count += std::all_of(&picture.rgb[i], &picture.rgb[i] + 3,
                             [&](int code) { return code >= first && code <= last; });
    return 3.0 * double(count) / double(picture.rgb.size());
}

TEST(Bake, ThePreviewOfASunlitSceneIsNeitherWhiteNorBlack)
{
    for (const char* scene : {"two-rooms-window.gltf", "room.gltf"}) {
        const Picture preview = preview_of(scene, {"--sun", "265,35"});
        EXPECT_LT(share(preview, 254, 255), 0.01) << scene;
        EXPECT_LT(share(preview, 0, 8), 0.05) << scene;
        EXPECT_NEAR(preview.mean(), 128.0, 30.0) << scene;
    }
}

TEST(Bake, ThePreviewHasSmoothEdgesAtLampsToo)
{
    // At the slanting sides of the lamp of the Cornell box about half of the pixels are between the
    // white of the lamp and the ceiling.
    const Picture preview = preview_of("cornell-box.gltf", {});
    const auto blue = [&](int x, int y) { return preview.at(x, y)[2]; };
    int beside = 0, between = 0;
    for (int y = 0; y < preview.height; ++y)
        for (int x = 1; x + 1 < preview.width; ++x)
            if (blue(x, y) < 250 && std::max(blue(x - 1, y), blue(x + 1, y)) >= 250) {
                ++beside;
                between += blue(x, y) > 150;
            }
    EXPECT_GT(beside, 10);
    EXPECT_GT(between, beside / 4);
}

TEST(Bake, SaysNothingWhenQuiet)
{
    const Workplace place;
    const Outcome bake =
        run_lumel(small_bake(place.path("out"), {"--shots", "64", "--quiet"}), {.terminal = true});
    EXPECT_EQ(bake.code, 0);
    EXPECT_EQ(bake.out, "");
    EXPECT_EQ(bake.err, "");
}

TEST(Bake, DrawsItsProgressOnATerminalOnly)
{
    const Workplace place;
    const auto arguments = small_bake(place.path("out"), {"--time", "1.5"});
    EXPECT_NE(run_lumel(arguments, {.terminal = true}).err.find("rays per lumel"),
              std::string::npos);
    EXPECT_EQ(run_lumel(arguments).err.find("rays per lumel"), std::string::npos);
}

TEST(Bake, OneSeedGivesOneMapByteForByte)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(small_bake(place.path("a"), {"--shots", "128", "--seed", "7"})).code, 0);
    ASSERT_EQ(run_lumel(small_bake(place.path("b"), {"--shots", "128", "--seed", "7"})).code, 0);
    EXPECT_EQ(bytes_of(place.path("a/lightmap.exr")), bytes_of(place.path("b/lightmap.exr")));
}

TEST(Bake, DirectionalLayersAreInTheReportAndInTheLightmapOnlyWhenAskedFor)
{
    const Workplace place;
    const auto plain = small_bake(place.path("a"), {"--shots", "64"});
    const auto asked = small_bake(place.path("b"), {"--shots", "64", "--directional", "sh1"});
    ASSERT_EQ(run_lumel(plain).code, 0);
    ASSERT_EQ(run_lumel(asked).code, 0);
    EXPECT_EQ(bytes_of(place.path("a/lightmap.exr")).find("sh.0.R"), std::string::npos);
    EXPECT_NE(bytes_of(place.path("b/lightmap.exr")).find("sh.3.B"), std::string::npos);
    const auto report = nlohmann::json::parse(bytes_of(place.path("b/report.json")));
    EXPECT_EQ(report["settings"]["directional"], "sh1");
    EXPECT_GT(report["solution"]["directional_shots"], 0);
    EXPECT_TRUE(report["units"].contains("lightmap.exr, layers sh.i"));
}

TEST(Bake, CtrlCWritesTheBestSolutionAndExits130)
{
    const Workplace place;
    const Outcome bake = run_lumel(small_bake(place.path("out"), {"--shots", "2000000000"}),
                                   {.interrupt_at = "rays per lumel"});
    EXPECT_EQ(bake.code, 130) << bake.err;
    EXPECT_EQ(place.listing(), inside("out"));
}

TEST(Bake, CtrlCBeforeThereIsLightLeavesWhatWasThere)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(small_bake(place.path("out"), {"--shots", "64"})).code, 0);
    const std::string before = bytes_of(place.path("out/lightmap.exr"));
    struct Work {
        std::string stage;
        std::vector<std::string> options;
    };
    const std::vector<Work> works = {
        {"charts", {"--size", "2048"}},
        {"solving", {"--size", "1024"}},
        {"sky and lamps",
         {"--size", "32", "--solver", "stochastic", "--sky", "1,1,1", "--sky-directions",
          "1000000"}},
    };
    for (const Work& work : works) {
        std::vector<std::string> arguments = {"bake", own_scene("cornell-box.gltf"),
                                              place.path("out"), "--preview-width", "0"};
        arguments.insert(arguments.end(), work.options.begin(), work.options.end());
        const Outcome bake = run_lumel(arguments, {.interrupt_at = work.stage});
        EXPECT_EQ(bake.code, 130) << bake.err;
        EXPECT_NE(bake.err.find("nothing is written"), std::string::npos) << bake.err;
        if (work.stage == "solving") {
            EXPECT_NE(bake.err.find("stopped before the first result"), std::string::npos)
                << bake.err;
        }
        EXPECT_EQ(place.listing(), inside("out"));
        EXPECT_EQ(bytes_of(place.path("out/lightmap.exr")), before);
    }
}

TEST(Reference, CtrlCBeforeEveryLumelHasAPathWritesNothing)
{
    const Workplace place;
    const Outcome reference =
        run_lumel({"reference", own_scene("cornell-box.gltf"), place.path("out"), "--size", "512"},
                  {.interrupt_at = "path tracing"});
    EXPECT_EQ(reference.code, 130) << reference.err;
    EXPECT_NE(reference.err.find("nothing is written"), std::string::npos) << reference.err;
    EXPECT_EQ(place.listing(), std::vector<std::string>{});
}

TEST(Bake, APreviewThatCannotBeMadeCostsNothingElse)
{
    const Workplace place;
    const Outcome bake = run_lumel({"bake", own_scene("cornell-box.gltf"), place.path("out"),
                                    "--size", "32", "--preview-width", "6000"});
    EXPECT_EQ(bake.code, 0) << bake.err;
    EXPECT_NE(bake.err.find("preview.png"), std::string::npos) << bake.err;
    EXPECT_TRUE(std::filesystem::exists(place.path("out/lightmap.exr")));
    const auto report = nlohmann::json::parse(bytes_of(place.path("out/report.json")));
    for (const auto& file : report["files"])
        EXPECT_TRUE(std::filesystem::exists(place.path("out/" + file.get<std::string>()))) << file;
}

TEST(Bake, TheReportSaysWhatSkyAndLampsTookOnTheDevice)
{
    const Workplace place;
    const Outcome bake =
        run_lumel(small_bake(place.path("out"), {"--solver", "stochastic", "--shots", "64", "--sky",
                                                 "1,1,1", "--json"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    const auto report = nlohmann::json::parse(bake.out, nullptr, false);
    const auto& times = report["timings"]["gpu"];
    ASSERT_TRUE(times.contains("sky and lamps: look along")) << times;
    EXPECT_GT(times["sky and lamps: look along"]["total_ms"], 0.0);
}

TEST(Bake, StopsAtTheTimeGiven)
{
    const Workplace place;
    const Outcome bake = run_lumel(small_bake(place.path("out"), {"--time", "1", "--json"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    EXPECT_FALSE(nlohmann::json::parse(bake.out, nullptr, false).is_discarded());
}

TEST(Bake, ADeviceThatIsNotThereIsExitCode3)
{
    const Workplace place;
    const auto arguments = small_bake(place.path("out"), {"--device", "no such device"});
    expect_one_sentence(run_lumel(arguments), 3, {"no such device"});
    EXPECT_TRUE(place.listing().empty());
}

TEST(Bake, APlaceThatCannotBeWrittenIsExitCode4)
{
    const Workplace place;
    const std::string file = place.file("file", "not a folder");
    expect_one_sentence(run_lumel(small_bake(file + "/out", {"--shots", "64"})), 4, {file});
    EXPECT_EQ(bytes_of(file), "not a folder");
}

TEST(Reference, WritesItsMapAndCompareMeasuresIt)
{
    const Workplace place;
    const Outcome reference = run_lumel({"reference", own_scene("cornell-box.gltf"),
                                         place.path("ref"), "--spp", "4", "--size", "32"});
    ASSERT_EQ(reference.code, 0) << reference.err;
    const std::string map = place.path("ref/lightmap.exr");
    const Outcome same = run_lumel({"compare", map, map, "-o", place.path("heat.png"), "--json"});
    ASSERT_EQ(same.code, 0) << same.err;
    const auto figures = nlohmann::json::parse(same.out, nullptr, false);
    ASSERT_FALSE(figures.is_discarded()) << same.out;
    EXPECT_EQ(figures["relative_rmse"], 0.0);
    EXPECT_EQ(figures["max"], 0.0);
    EXPECT_GT(figures["texels"], 100);
    EXPECT_EQ(bytes_of(place.path("heat.png")).substr(1, 3), "PNG");
}

TEST(Reference, SaysWhetherGlossCounts)
{
    const Workplace place;
    for (const bool gloss : {false, true}) {
        std::vector<std::string> line = {"reference",
                                         own_scene("cornell-box.gltf"),
                                         place.path("ref"),
                                         "--spp",
                                         "1",
                                         "--size",
                                         "32",
                                         "--json"};
        if (gloss)
            line.emplace_back("--gloss");
        const Outcome outcome = run_lumel(line);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(report["settings"]["gloss"], gloss) << outcome.out;
    }
}

// The blocks of the box are of metal: half of what they reflect is missing without gloss.
TEST(Reference, WithGlossHasTheMapOfAGlossyBake)
{
    const Workplace place;
    const std::string scene = own_scene("glossy-cornell-box.gltf");
    const auto map = [&](const char* folder, std::vector<std::string> line) {
        line.insert(line.end(), {"--size", "32", "-q"});
        const Outcome outcome = run_lumel(line);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return place.path(folder) + "/lightmap.exr";
    };
    const std::string baked =
        map("baked", {"bake", scene, place.path("baked"), "--solver", "glossy", "--shots", "4096"});
    const auto reference = [&](const char* folder, std::vector<std::string> more) {
        std::vector<std::string> line{"reference", scene, place.path(folder), "--spp", "1024"};
        line.insert(line.end(), more.begin(), more.end());
        return map(folder, line);
    };
    const double with_gloss = rmse_between(baked, reference("glossy", {"--gloss"}));
    const double without = rmse_between(baked, reference("diffuse", {}));
    RecordProperty("with_gloss", std::to_string(with_gloss));
    RecordProperty("without", std::to_string(without));
    EXPECT_LE(with_gloss, 0.07);  // noise of both
    EXPECT_GE(without, 2.0 * with_gloss);
}

TEST(Reference, SaysWhichPartOfTheLightItHas)
{
    const Workplace place;
    for (const std::string only : {"direct", "indirect"}) {
        const Outcome outcome =
            run_lumel({"reference", own_scene("cornell-box.gltf"), place.path(only), "--spp", "1",
                       "--size", "32", "--only", only, "--json"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(report["settings"]["only"], only) << outcome.out;
    }
}

TEST(Info, SaysWhatABakeWouldTakeAndWritesNothing)
{
    const Outcome text = run_lumel({"info", own_scene("cornell-box.gltf"), "--size", "32"});
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("lumels"), std::string::npos) << text.out;
    const Outcome json =
        run_lumel({"info", own_scene("cornell-box.gltf"), "--size", "32", "--json"});
    EXPECT_FALSE(nlohmann::json::parse(json.out, nullptr, false).is_discarded()) << json.out;
}

/// What a bake of the Cornell box takes, as info has it [bytes].
std::uint64_t memory(std::vector<std::string> options)
{
    options.insert(options.begin(),
                   {"info", own_scene("cornell-box.gltf"), "--size", "32", "--json"});
    const Outcome outcome = run_lumel(options);
    return nlohmann::json::parse(outcome.out, nullptr, false)
        .value("graphics_memory_bytes", std::uint64_t(0));
}

TEST(Info, CountsTheMemoryOfDirectionalLightmaps)
{
    const std::uint64_t plain = memory({}), sh1 = memory({"--directional", "sh1"});
    EXPECT_EQ(plain, 0u);  // the host solves it
    EXPECT_GT(sh1, plain);
    EXPECT_GT(memory({"--directional", "sh2"}), sh1);
}

TEST(Info, CountsTheMemoryOfDirectLight)
{
    // Views of shooters so small that those of the sky are what takes most.
    const std::uint64_t dark = memory({"--solver", "stochastic", "--hemicube", "16"});
    EXPECT_GT(memory({"--solver", "stochastic", "--hemicube", "16", "--sky", "1,1,1"}), dark);
    // Links find it on the host.
    EXPECT_EQ(memory({"--sky", "1,1,1"}), memory({}));
}

TEST(Devices, ListsAtLeastOneThatCanBeUsed)
{
    const Outcome devices = run_lumel({"devices", "--json"});
    ASSERT_EQ(devices.code, 0) << devices.err;
    const auto list = nlohmann::json::parse(devices.out, nullptr, false);
    ASSERT_TRUE(list.is_array()) << devices.out;
    EXPECT_TRUE(
        std::any_of(list.begin(), list.end(), [](const auto& device) { return device["usable"]; }));
}

}  // namespace
}  // namespace lumel::test
