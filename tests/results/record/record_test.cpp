// A finished bake is read back as it was, or not at all.

#include <filesystem>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "../../support/input_error.h"
#include "base/json/json_file.h"
#include "results/record/bake_record.h"
#include "results/record/light_settings.h"
#include "results/record/solver_settings.h"

namespace lumel {
namespace {

/// A record in which nothing is as it is by default.
BakeRecord unusual()
{
    BakeRecord record{.scene = "room.glb",
                      .scene_hash = "0123456789abcdef",
                      .sky_directions = 77,
                      .parts = Parts::indirect,
                      .directional = Directional::sh2,
                      .half = true,
                      .compression = Compression::meshopt,
                      .pages = {4, 48},
                      .texels_per_metre = 12.345678,
                      .shots = 123456,
                      .iterations = 789,
                      .error = 0.0123,
                      .interrupted = true,
                      .exposure = 0.0625f,
                      .files = {"lightmap.exr", "report.json"}};
    record.lights.sky_file = "/skies/noon.exr";
    record.lights.sky_scale = 0.1f;
    record.lights.ground = 0.2f;
    record.lights.sky_rotation = glm::radians(30.0);
    record.lights.sun = SunPosition{glm::radians(10.0), glm::radians(35.0)};
    record.lights.sun_seen = {47.5, 19.04, "2024-06-21T12:00:00+02:00"};
    record.lights.sun_angle = float(glm::radians(0.3));
    record.lights.light_radius = 0.025f;
    record.lights.profiles = {{"bulb", "/lamps/a.ies"}, {"spot", "/lamps/b.ies"}};
    record.atlas = {
        .texels_per_metre = 12.3f, .size = 96, .max_size = 1024, .pages = 9, .gutter = 3};
    record.solver.method = DirectionsOptions{.seed = 4294967295u,
                                             .batch = 5,
                                             .rule = SampleRule::centre,
                                             .iteration = {Scheme::paper},
                                             .layers = Layers::stochastic,
                                             .lookups = 5,
                                             .lookup_test = LookupTest::paper,
                                             .slabs = 7,
                                             .map_side = 333};
    record.solver.max_shots = 4096;
    record.solver.max_seconds = 12.5;
    record.solver.target_error = 0.005;
    return record;
}

Json json_of(const BakeRecord& record)
{
    Report report = report_of(record);
    report.date.clear();  // of now
    return to_json(report);
}

BakeRecord read(const Json& report)
{
    const std::string file = "out/report.json";
    return record_of(JsonView(file, report), "out");
}

/// What reading has to say against a report; empty: nothing.
std::string complaint(const Json& report)
{
    return test::input_error_of([&] { read(report); });
}

void expect_complaint(const Json& report, const std::string& words)
{
    const std::string said = complaint(report);
    EXPECT_NE(said.find(words), std::string::npos) << said;
}

/// Pointers to all values that are read of a record's report and are no objects or lists.
std::vector<std::string> fields_of(const Json& report)
{
    std::vector<std::string> pointers;
    const Json flat = report.flatten();
    for (const auto& [pointer, value] : flat.items())
        for (const char* part :
             {"/settings/", "/lights/", "/solver/", "/files/", "/scene/", "/sizes/atlas_width",
              "/sizes/texels_per_metre", "/solution/shots", "/solution/iterations",
              "/solution/interrupted", "/solution/estimated_error", "/solution/exposure"})
            if (pointer.starts_with(part))
                pointers.push_back(pointer);
    return pointers;
}

TEST(BakeRecord, IsReadBackAsItWasWritten)
{
    for (const BakeRecord& record :
         {unusual(), BakeRecord{.scene = "a", .scene_hash = "b", .pages = {1, 32}}}) {
        const Json report = json_of(record);
        // Through text, as in a file.
        EXPECT_EQ(json_of(read(Json::parse(json_text(report)))), report);
    }
    const BakeRecord same = read(json_of(unusual()));
    EXPECT_EQ(same.lights.sky_scale, 0.1f);
    EXPECT_EQ(same.lights.ground, 0.2f);
    EXPECT_EQ(same.lights.sun->azimuth, glm::radians(10.0));
    EXPECT_EQ(same.lights.sun_angle, float(glm::radians(0.3)));
    EXPECT_EQ(same.atlas.texels_per_metre, 12.3f);
    EXPECT_EQ(seed_of(same.solver.method), 4294967295u);
    EXPECT_EQ(same.exposure, 0.0625f);
}

TEST(BakeRecord, HasNumbersAsNumbersAndAnglesAsTheyWereGiven)
{
    const Json report = json_of(unusual());
    EXPECT_EQ(report["settings"]["gutter"], 3);
    EXPECT_EQ(report["settings"]["half"], true);
    EXPECT_EQ(report["settings"]["texels-per-metre"].dump(), "12.3");
    EXPECT_EQ(report["lights"]["sun"]["elevation"].dump(), "35.0");
    EXPECT_EQ(report["lights"]["sun"]["latitude"].dump(), "47.5");
    EXPECT_EQ(report["lights"]["sun"]["longitude"].dump(), "19.04");
    EXPECT_EQ(report["lights"]["sun"]["time"], "2024-06-21T12:00:00+02:00");
    EXPECT_EQ(report["lights"]["sky-scale"].dump(), "0.1");
    EXPECT_EQ(report["solver"]["options"]["layers"], "stochastic");
    EXPECT_EQ(report["solver"]["limits"]["error"], 0.005);
}

TEST(BakeRecord, KeepsEveryProfile)
{
    const BakeRecord record = read(json_of(unusual()));
    ASSERT_EQ(record.lights.profiles.size(), 2u);
    EXPECT_EQ(record.lights.profiles[0].light, "bulb");
    EXPECT_EQ(record.lights.profiles[1].path, "/lamps/b.ies");
}

TEST(BakeRecord, KeepsTheOvercastSky)
{
    BakeRecord overcast = unusual();
    overcast.lights.sky_file.clear();
    overcast.lights.cie = CieSky{.lux = 7654.0f};
    const Json report = json_of(overcast);
    EXPECT_EQ(report["lights"]["sky"]["overcast"].dump(), "7654.0");
    EXPECT_EQ(read(report).lights.cie.value().lux, 7654.0f);
    EXPECT_EQ(read(report).lights.cie.value().type, kOvercastType);
    overcast.lights.cie = CieSky{.type = 12, .lux = 7654.0f, .sun = SunPosition{0.5, 0.25}};
    const CieSky clear = read(json_of(overcast)).lights.cie.value();
    EXPECT_EQ(clear.type, 12);
    EXPECT_EQ(clear.lux, 7654.0f);
    EXPECT_EQ(clear.sun.value().azimuth, 0.5);
    EXPECT_EQ(clear.sun.value().elevation, 0.25);
}

TEST(BakeRecord, FilesOfLightsAreFoundFromAnyFolder)
{
    LightOptions options;
    options.sky_file = "sky.hdr";
    options.profiles = {{"bulb", "lamps/../a.ies"}};
    const Json lights = light_settings(options);
    const auto here = std::filesystem::current_path();
    EXPECT_EQ(lights["sky"]["file"], (here / "sky.hdr").string());
    EXPECT_EQ(lights["ies"][0]["file"], (here / "a.ies").string());
    try {
        check_light_files(options);
        FAIL() << "there is no sky.hdr";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("sky.hdr"), std::string::npos);
    }
}

TEST(BakeRecord, EveryFieldOfAnotherTypeIsNamed)
{
    const Json report = json_of(unusual());
    const std::vector<std::string> fields = fields_of(report);
    EXPECT_GT(fields.size(), 40u);
    for (const std::string& pointer : fields) {
        Json broken = report;
        broken[Json::json_pointer(pointer)] = Json::object({{"no", "value"}});
        const std::string said = complaint(broken);
        EXPECT_NE(said.find("out/report.json: " + pointer + ": "), std::string::npos)
            << pointer << ": " << said;
    }
}

TEST(BakeRecord, EveryNumberOutOfBoundsIsNamed)
{
    const Json report = json_of(unusual());
    std::size_t numbers = 0;
    for (const std::string& pointer : fields_of(report)) {
        if (!report[Json::json_pointer(pointer)].is_number())
            continue;
        ++numbers;
        for (const double value : {-1e30, 1e300}) {
            // No number is too large for an error.
            if (value > 0.0 && pointer == "/solution/estimated_error")
                continue;
            Json broken = report;
            broken[Json::json_pointer(pointer)] = value;
            const std::string said = complaint(broken);
            EXPECT_NE(said.find(pointer), std::string::npos) << pointer << ": " << said;
        }
    }
    EXPECT_GT(numbers, 20u);
}

TEST(BakeRecord, AMissingFieldIsNamed)
{
    Json report = json_of(unusual());
    report["solver"]["options"].erase("batch");
    expect_complaint(report, "out/report.json: /solver/options: \"batch\" is missing");
}

TEST(BakeRecord, AnUnknownMethodAndAnUnknownWordAreNamed)
{
    Json report = json_of(unusual());
    report["solver"]["method"] = "magic";
    expect_complaint(report, "/solver/method");
    report = json_of(unusual());
    report["settings"]["only"] = "most";
    expect_complaint(report,
                     "/settings/only: is \"most\", but must be one of all, direct, indirect");
}

TEST(BakeRecord, OfAnotherFormIsRefused)
{
    Json report = json_of(unusual());
    report["format"] = kReportFormat + 1;
    expect_complaint(report, "/format");
    report.erase("format");
    expect_complaint(report, "bake the scene again");
}

TEST(BakeRecord, SaysWithWhichLibrariesAndWhen)
{
    const Report report = report_of(unusual());
    for (const char* library :
         {"Draco", "Embree", "OpenEXR", "libpng", "libwebp", "meshoptimizer", "oneTBB"})
        EXPECT_NE(report.library_versions.at(library), "") << library;
    // 2026-05-01T18:30:00+02:00
    ASSERT_EQ(report.date.size(), 25u) << report.date;
    EXPECT_EQ(report.date[10], 'T');
    EXPECT_EQ(report.date[22], ':');
}

}  // namespace
}  // namespace lumel
