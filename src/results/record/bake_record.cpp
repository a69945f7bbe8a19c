#include "results/record/bake_record.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "base/core/error.h"
#include "base/json/json_file.h"
#include "results/record/fields.h"
#include "results/record/light_settings.h"
#include "results/record/origin.h"
#include "results/record/solver_settings.h"

namespace lumel {
namespace {

constexpr Limits kSides{0.0, 65536.0};  // [texels]
constexpr Limits kPages{1.0, kMaxPages};
constexpr Limits kDensities{0.0, 1e9};  // [1/m]
constexpr Limits kCounts{0.0, 1e15};
constexpr int kMaxStoredLinks = 1 << 24;  // rays per lumel
constexpr Limits kErrors{0.0, std::numeric_limits<double>::max()};

template <class Options, class Visit>
void each_atlas_setting(Options& options, const Visit& visit)
{
    visit("texels-per-metre", options.texels_per_metre, kDensities);
    visit("size", options.size, kSides);
    visit("max-size", options.max_size, kSides);
    visit("gutter", options.gutter, kSides);
    visit("sides", options.sides);
}

/// Omitted if nothing is set, as in reports of older bakes.
void write_densities(const AtlasOptions& options, Json& settings)
{
    if (options.coarse_afar)
        settings["coarse-afar"] = true;
    if (options.pages > 1)
        settings["pages"] = options.pages;
    for (const DensityRule& rule : options.densities)
        settings["density"].push_back(
            {{"name", rule.pattern}, {"texels_per_metre", shortest(rule.texels_per_metre)}});
}

VisibleNoise visible_noise_of(const JsonView& object)
{
    VisibleNoise noise{.worst_chart = object.get("worst_chart").number(kErrors.low, kErrors.high)};
    object.each("bands", [&](const JsonView& band, std::size_t b) {
        if (b < noise.bands.size())
            noise.bands[b] = band.number(kErrors.low, kErrors.high);
    });
    return noise;
}

int pages_of(const JsonView& object)
{
    const auto pages = object.find("pages");
    return pages ? int(pages->integer(std::int64_t(kPages.low), std::int64_t(kPages.high))) : 1;
}

void read_densities(const JsonView& settings, AtlasOptions& options)
{
    options.coarse_afar = settings.boolean_or("coarse-afar", false);
    options.pages = pages_of(settings);
    settings.each("density", [&](const JsonView& rule, std::size_t) {
        options.densities.push_back(
            {rule.get("name").string(),
             float(rule.get("texels_per_metre").number(kDensities.low, kDensities.high))});
    });
}

/// Settings that are omitted unless given, as in reports of older bakes.
void write_given(const BakeRecord& record, Json& settings)
{
    if (record.given_exposure > 0.0f)
        settings["exposure"] = shortest(record.given_exposure);
    if (record.compression != Compression::none)
        settings["compress"] = word_of(record.compression);
    if (record.keep_links > 0)
        settings["keep-links"] = record.keep_links;
    if (const auto* links = std::get_if<LinksOptions>(&record.solver.method);
        links && links->even_rays > 0)
        settings["links"] = links->even_rays;
}

void read_given(const JsonView& settings, BakeRecord& record)
{
    if (const auto exposure = settings.find("exposure"))
        record.given_exposure = float(exposure->number(0.0, std::numeric_limits<float>::max()));
    if (const auto compression = settings.find("compress"))
        record.compression = value_of_word<Compression>(*compression);
    if (const auto rays = settings.find("keep-links"))
        record.keep_links = std::uint32_t(rays->integer(1, kMaxStoredLinks));
    auto* links = std::get_if<LinksOptions>(&record.solver.method);
    if (const auto rays = settings.find("links"); rays && links)
        links->even_rays = std::uint32_t(rays->integer(1, kMaxStoredLinks));
}

template <class Record, class Visit>
void each_setting(Record& record, const Visit& visit)
{
    each_atlas_setting(record.atlas, visit);
    visit("sky-directions", record.sky_directions);
    visit("only", record.parts);
    visit("directional", record.directional);
    visit("half", record.half);
    visit("keep-lights", record.keep_lights);
    visit("lightmap-format", record.lightmap_format);
    visit("baked-size", record.baked_size, kSides);
}

[[noreturn]] void refuse(const std::string& folder, const std::string& what)
{
    throw Error(ErrorKind::input, folder, what);
}

void check_format(const JsonView& report)
{
    const auto format = report.find("format");
    if (!format)
        report.fail("is not of a bake by this version of lumel; bake the scene again");
    if (format->integer(0, std::numeric_limits<int>::max()) != kReportFormat)
        format->fail("is " + format->json().dump() + ", but this version of lumel reads " +
                     std::to_string(kReportFormat) + "; bake the scene again");
}

}  // namespace

Json atlas_settings(const AtlasOptions& options)
{
    Json settings;
    each_atlas_setting(options, FieldWriter(settings));
    write_densities(options, settings);
    return settings;
}

Report report_of(const BakeRecord& record)
{
    Report report;
    report.lumel_version = lumel_version();
    report.date = local_time();
    report.library_versions = library_versions();
    report.scene = record.scene;
    report.scene_hash = record.scene_hash;
    each_setting(record, FieldWriter(report.settings));
    write_densities(record.atlas, report.settings);
    write_given(record, report.settings);
    report.lights = light_settings(record.lights);
    report.solver = solver_settings(record.solver);
    report.atlas_width = report.atlas_height = record.pages.map_side();
    report.pages = record.pages.count;
    report.texels_per_metre = record.texels_per_metre;
    report.shots = record.shots;
    report.iterations = record.iterations;
    report.estimated_error = record.error;
    report.estimated_dark_error = record.dark_error;
    report.estimated_eye_error = record.eye_error;
    report.visible_noise = record.visible_noise;
    report.interrupted = record.interrupted;
    report.exposure = record.exposure;
    report.files = record.files;
    return report;
}

BakeRecord record_of(const JsonView& report, const std::string& folder)
{
    check_format(report);
    BakeRecord record;
    record.scene = report.get("scene").get("file").string();
    record.scene_hash = report.get("scene").get("hash").string();
    each_setting(record, FieldReader(report.get("settings")));
    read_densities(report.get("settings"), record.atlas);
    record.lights = light_options_of(report.get("lights"), folder);
    record.solver = solver_options_of(report.get("solver"));
    read_given(report.get("settings"), record);

    const FieldReader size(report.get("sizes"));
    int side = 0;
    size("atlas_width", side, kSides);
    record.pages.count = pages_of(report.get("sizes"));
    record.pages.side = side / record.pages.across();
    size("texels_per_metre", record.texels_per_metre, kDensities);

    const JsonView solution = report.get("solution");
    const FieldReader result(solution);
    result("shots", record.shots, kCounts);
    result("iterations", record.iterations, kCounts);
    result("interrupted", record.interrupted);
    if (solution.find("estimated_error"))
        result("estimated_error", record.error, kErrors);
    if (solution.find("estimated_dark_error"))
        result("estimated_dark_error", record.dark_error, kErrors);
    if (solution.find("estimated_eye_error"))
        result("estimated_eye_error", record.eye_error, kErrors);
    if (const auto noise = solution.find("visible_noise"))
        record.visible_noise = visible_noise_of(*noise);
    if (const auto exposure = solution.find("exposure"))
        record.exposure = float(exposure->number(0.0, std::numeric_limits<float>::max()));
    report.each("files",
                [&](const JsonView& file, std::size_t) { record.files.push_back(file.string()); });
    return record;
}

SolverOptions reached_targets(const BakeRecord& record)
{
    SolverOptions options = record.solver;
    const auto reach = [](double& target, double now) {
        if (target > 0.0)
            target = std::max(target, now);
    };
    reach(options.target_error, record.error);
    reach(options.target_dark_error, record.dark_error);
    reach(options.target_quality.visible_noise, record.visible_noise.worst_chart);
    reach(options.target_quality.eye_error, record.eye_error);
    return options;
}

std::uint64_t ray_limit(const BakeRecord& record)
{
    const SolverOptions &given = record.solver, reached = reached_targets(record);
    const bool has_missed = !given.has_target() || reached.target_error > given.target_error ||
                            reached.target_dark_error > given.target_dark_error ||
                            reached.target_quality != given.target_quality;
    const bool is_cut_short = record.interrupted || (given.max_seconds > 0.0 && has_missed);
    return is_cut_short ? record.shots : given.max_shots;
}

BakeRecord read_bake_record(const std::string& folder)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (const char* file : {kReportFile, kSceneFile, kSolutionFile})
        if (!fs::is_regular_file(fs::path(folder) / file, ignored))
            refuse(folder, std::string("has no ") + file +
                               ": it is not the folder of a finished lumel bake");
    const std::string path = (fs::path(folder) / kReportFile).string();
    const Json report = read_json(path);
    return record_of(JsonView(path, report), folder);
}

void check_whole(const std::string& folder, const BakeRecord& baked)
{
    if (baked.parts != Parts::all)
        refuse(folder, "has only part of the light; bake it again without --only");
}

void check_correctable(const std::string& folder, const BakeRecord& baked)
{
    if (method_of(baked.solver.method).materials == MaterialModel::glossy)
        refuse(folder, "was baked with gloss, which cannot be corrected yet; bake it again");
    if (baked.directional != Directional::none)
        refuse(folder, "has directional layers, which cannot be corrected yet; bake it again");
    check_whole(folder, baked);
}

}  // namespace lumel
