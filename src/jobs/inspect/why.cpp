#include "jobs/inspect/why.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/edit/finished_bake.h"
#include "jobs/inspect/why_picture.h"
#include "jobs/solve/stages.h"
#include "methods/methods.h"
#include "results/files/folder.h"
#include "results/measure/contributors.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPicture = "why.png";

/// Texel in the whole map.
glm::ivec2 texel_of(const WhyOptions& options, const Pages& pages)
{
    if (options.page >= pages.count)
        throw Error(ErrorKind::input, "--page",
                    pages.count == 1
                        ? "the lightmap has one page, 0"
                        : fmt::format("the lightmap has {} pages, from 0", pages.count));
    const glm::ivec2 corner = pages.corner(options.page);
    if (!options.texel)
        return corner +
               glm::min(glm::ivec2(options.place * double(pages.side)), glm::ivec2(pages.side - 1));
    if (glm::any(glm::greaterThanEqual(*options.texel, glm::ivec2(pages.side))))
        throw Error(ErrorKind::input, "--texel",
                    fmt::format("the lightmap has {} columns and rows, from 0", pages.side));
    return corner + *options.texel;
}

/// In terms of the options: --texel X,Y, and --page if there are several.
std::string name_of(const glm::ivec2& texel, const Pages& pages)
{
    const int page = pages.at(glm::vec2(texel));
    const glm::ivec2 there = texel - pages.corner(page);
    return fmt::format("{}--texel {},{}", pages.count > 1 ? fmt::format("--page {} ", page) : "",
                       there.x, there.y);
}

glm::ivec2 nearest(const std::vector<std::uint32_t>& shown, int side, const glm::ivec2& texel)
{
    glm::ivec2 best(0);
    int least = -1;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::ivec2 way = glm::ivec2(x, y) - texel;
            const int far = way.x * way.x + way.y * way.y;
            if (shown[std::size_t(y) * std::size_t(side) + std::size_t(x)] != kNoLumel &&
                (least < 0 || far < least)) {
                least = far;
                best = {x, y};
            }
        }
    return best;
}

std::uint32_t lumel_at(const glm::ivec2& texel, const Pages& pages, const Lumels& lumels,
                       const std::vector<glm::vec3>& irradiance)
{
    std::vector<std::uint32_t> shown = shown_lumels(lumels, irradiance);
    const std::size_t at = std::size_t(texel.y) * std::size_t(lumels.width) + std::size_t(texel.x);
    const bool covered = shown[at] != kNoLumel;
    for (std::uint32_t& lumel : shown)
        if (lumel != kNoLumel && (lumels.lumels[lumel].flags & kLumelBuried))
            lumel = kNoLumel;
    if (shown[at] != kNoLumel)
        return shown[at];
    const glm::ivec2 other = nearest(shown, lumels.width, texel);
    throw Error(ErrorKind::input, "",
                fmt::format("{} column {}, row {} of the lightmap; the nearest texel with light is "
                            "{}",
                            covered ? "other geometry lies on" : "no surface is at",
                            texel.x % pages.side, texel.y % pages.side, name_of(other, pages)));
}

WhyRow row_of(const Scene& scene, const Contributor& sender, double whole)
{
    WhyRow row{.share = luminance(sender.light) / whole,
               .name = "sky",
               .distance = double(sender.distance),
               .light = sender.light};
    if (sender.kind == Contributor::Kind::surface) {
        row.name = scene.instances[sender.index].name;
        row.material = scene.materials[std::size_t(sender.material)].name;
    } else if (sender.kind == Contributor::Kind::lamp) {
        row.name = scene.lights[sender.index].name;
    }
    if (sender.distance > 0.0f)
        row.place = glm::dvec3(sender.place) + scene.origin;
    return row;
}

std::vector<std::pair<std::string, double>> sums_by_name(const std::vector<WhyRow>& rows)
{
    std::map<std::string, double> sums;
    for (const WhyRow& row : rows)
        sums[row.name] += row.share;
    std::vector<std::pair<std::string, double>> list(sums.begin(), sums.end());
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return list;
}

std::string report_of(const WhySummary& summary)
{
    Json json;
    json["units"] = {{"light", "lx"}, {"place", "m"}, {"share", "of the incoming luminance"}};
    json["lumel"] = {{"instance", summary.instance},
                     {"page", summary.page},
                     {"texel", {summary.texel.x, summary.texel.y}},
                     {"place", json_array(summary.place)},
                     {"irradiance", json_array(summary.solved)},
                     {"found", json_array(summary.found)}};
    if (!summary.remark.empty())
        json["remark"] = summary.remark;
    json["by_name"] = Json::array();
    for (const auto& [name, share] : summary.by_name)
        json["by_name"].push_back({{"name", name}, {"share", share}});
    json["senders"] = Json::array();
    for (const WhyRow& row : summary.rows) {
        Json sender = {{"share", row.share}, {"name", row.name}};
        if (!row.material.empty())
            sender["material"] = row.material;
        if (row.place) {
            sender["place"] = json_array(*row.place);
            sender["distance"] = row.distance;
        }
        sender["light"] = json_array(row.light);
        json["senders"].push_back(std::move(sender));
    }
    return json_text(json);
}

WhySummary summary_of(const SolveScene& prepared, std::uint32_t lumel, const Senders& senders)
{
    const Lumel& there = prepared.lumels.lumels[lumel];
    const Instance& instance = prepared.scene.instances[there.instance];
    WhySummary summary{.instance = instance.name,
                       .place = glm::dvec3(instance.transform * glm::vec4(there.position, 1.0f)) +
                                prepared.scene.origin,
                       .found = senders.light};
    const double whole = luminance(senders.light);
    for (const Contributor& sender : senders.list)
        summary.rows.push_back(row_of(prepared.scene, sender, whole));
    summary.by_name = sums_by_name(summary.rows);
    return summary;
}

}  // namespace

std::string remark_on_rays(double solved, double found, double noise, double error)
{
    constexpr double kPlain = 10.0;  // from here on, no decimals
    constexpr double kSigmas = 3.0;  // of 370 normally distributed differences, one is larger
    // A bake that states no error may not be finished.
    if (error < 0.0 || std::abs(found - solved) <= kSigmas * std::hypot(noise, error * solved))
        return {};
    const double ratio = found / solved;
    const std::string times =
        ratio < kPlain ? fmt::format("{:.2g}", ratio) : fmt::format("{:.0f}", ratio);
    return fmt::format(
        "{}, more than noise explains. At an edge or beside other geometry, the "
        "bake has the light of the part of the texel that is open, and rays start from all of it",
        solved > 0.0 ? "rays find " + times + " times the light of the bake"
                     : "rays find light where the bake has none");
}

WhySummary why(const std::string& folder, const WhyOptions& options,
               const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    const FinishedBake bake(folder);
    const SolveScene& prepared = bake.prepared;
    const std::vector<glm::vec3>& irradiance = bake.irradiance;
    const Pages& pages = prepared.atlas.pages;
    const glm::ivec2 texel = texel_of(options, pages);
    const std::uint32_t lumel = lumel_at(texel, pages, prepared.lumels, irradiance);

    stages.begin("rays");
    const Senders senders =
        find_senders(prepared, irradiance, lumel, {.seed = seed_of(bake.record.solver.method)});
    WhySummary summary = summary_of(prepared, lumel, senders);
    summary.page = pages.at(glm::vec2(texel));
    summary.texel = texel - pages.corner(summary.page);
    summary.solved = irradiance[lumel];
    summary.remark =
        remark_on_rays(luminance(summary.solved), luminance(summary.found), senders.noise,
                       std::max(bake.record.error, bake.record.dark_error));
    summary.report = report_of(summary);
    if (options.width > 0) {
        stages.begin("picture");
        OutputFile output((fs::path(folder) / kPicture).string());
        const gpu::Device device(options.device);
        write_png(output.path(),
                  why_picture(device, prepared, irradiance, senders.density, lumel, options.width));
        device.check_validation();
        output.commit();
    }
    stages.end();
    return summary;
}

}  // namespace lumel
