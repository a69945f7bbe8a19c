#include "jobs/bake/lamp_maps.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "results/record/bake_record.h"

namespace lumel {
namespace {

/// Maximum length of a lamp's name in a file name [bytes].
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kTexelsPerTask = 4096;
/// For the difference of the sum, texels darker than this × the brightest count as that bright.
constexpr float kDarkestCounted = 1e-6f;

/// Cuts UTF-8 text to at most `most` bytes, between two characters.
std::string beginning_of(const std::string& text, std::size_t most)
{
    constexpr unsigned char kTopBits = 0xC0,
                            kContinued = 0x80;  // of a byte that continues a character
    std::size_t end = std::min(most, text.size());
    while (end > 0 && end < text.size() &&
           (static_cast<unsigned char>(text[end]) & kTopBits) == kContinued)
        --end;
    return text.substr(0, end);
}

/// A name without what file systems, shells and web addresses treat specially.
std::string as_file_name(const std::string& name)
{
    std::string safe = beginning_of(name, kLongestName);
    for (char& letter : safe) {
        const bool is_plain = (letter >= 'a' && letter <= 'z') ||
                              (letter >= 'A' && letter <= 'Z') ||
                              (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
        if (!is_plain && static_cast<unsigned char>(letter) < 0x80)
            letter = '_';
    }
    return safe;
}

/// As file systems compare names that do not tell capitals from small letters.
std::string in_small_letters(std::string name)
{
    for (char& letter : name)
        if (letter >= 'A' && letter <= 'Z')
            letter = char(letter - 'A' + 'a');
    return name;
}

/// Makes one value of all layers positive, and their sum that of the whole. Light that no layer has
/// goes to the first.
void make_sum_exact(FinishedMaps& maps, std::size_t v)
{
    float sum = 0.0f;
    for (Image& map : maps.layers)
        sum += map.values[v] = std::max(map.values[v], 0.0f);
    const float whole = maps.light.values[v];
    for (Image& map : maps.layers)
        map.values[v] *= sum > 0.0f ? whole / sum : 0.0f;
    if (!(sum > 0.0f))
        maps.layers.front().values[v] = whole;
}

/// Largest difference between the sum of the maps and the whole, relative to the whole.
double error_of_sum(const Image& whole, const std::vector<Image>& maps)
{
    float brightest = 0.0f;
    for (std::size_t v = 0; v < whole.values.size(); ++v)
        if (v % 4 != 3)
            brightest = std::max(brightest, whole.values[v]);
    double worst = 0.0;
    for (std::size_t v = 0; v < whole.values.size(); ++v) {
        if (v % 4 == 3 || !(whole.values[v] > 0.0f))
            continue;
        double sum = 0.0;
        for (const Image& map : maps)
            sum += double(map.values[v]);
        const double least = double(kDarkestCounted * brightest);
        worst = std::max(worst, std::abs(sum - double(whole.values[v])) /
                                    std::max(double(whole.values[v]), least));
    }
    return worst;
}

}  // namespace

glm::dvec3 lamp_colour(std::span<const glm::vec3> irradiance)
{
    glm::dvec3 sum(0.0);
    for (const glm::vec3& light : irradiance)
        sum += glm::dvec3(light);
    const double most = std::max({sum.r, sum.g, sum.b});
    return most > 0.0 ? sum / most : glm::dvec3(1.0);
}

void set_per_lamp(BakeOptions& options, bool wanted, std::vector<LampGroup> groups)
{
    if (!wanted && groups.empty())
        return;
    auto* const links = std::get_if<LinksOptions>(&options.solver.method);
    if (!links)
        throw Error(ErrorKind::input, "--per-lamp with another solver",
                    "is not possible: only --solver links keeps the light of lamps apart");
    links->per_lamp = true;
    links->groups = std::move(groups);
}

std::optional<LampLights> keep_lamps_apart(Solver& solver, Stages& stages)
{
    auto* const links = dynamic_cast<LinkRadiosity*>(&solver);
    if (!links || !links->lamps())
        return std::nullopt;
    stages.begin("lamps");
    std::optional<LinkRadiosity::LampsLight> light;
    if (!stages.stopped())
        light = links->light_of_lamps([&](double fraction) { return stages.progress(fraction); });
    if (!light)
        return std::nullopt;
    return LampLights{links->lamps()->all, std::move(light->lamps)};
}

FinishedMaps lamp_maps(const SolveScene& prepared, std::span<const glm::vec3> irradiance,
                       const std::vector<LinkRadiosity::LampLight>& lamps)
{
    std::vector<std::vector<glm::vec3>> layers;
    for (const LinkRadiosity::LampLight& lamp : lamps)
        layers.push_back(lamp.irradiance);
    FinishedMaps finished =
        finish_maps(prepared.scene, prepared.atlas, prepared.lumels, irradiance, layers);
    // Seams are matched by least squares, which can leave a dark lamp slightly negative.
    parallel_for(finished.light.values.size() / 4, kTexelsPerTask,
                 [&](std::size_t from, std::size_t to) {
                     for (std::size_t v = 4 * from; v < 4 * to; ++v)
                         if (v % 4 != 3)
                             make_sum_exact(finished, v);
                 });
    return finished;
}

std::vector<std::string> lamp_map_names(const std::vector<NamedLamp>& lamps)
{
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const NamedLamp& lamp : lamps) {
        const std::string plain = kLampPrefix + as_file_name(lamp.name);
        std::string name = plain;
        for (int number = 2; !taken.insert(in_small_letters(name)).second; ++number)
            name = plain + "_" + std::to_string(number);
        names.push_back(name);
    }
    return names;
}

WrittenLamps write_lamps(const OutputFolder& folder, const BakeOptions& options,
                         const SolveScene& prepared, std::span<const glm::vec3> irradiance,
                         const LampLights& lamps, Stages& stages)
{
    FinishedMaps finished = lamp_maps(prepared, irradiance, lamps.light);
    const double apart = error_of_sum(finished.light, finished.layers);
    WrittenLamps written{.maps = std::move(finished.layers)};
    const std::vector<std::string> names = lamp_map_names(lamps.lamps);
    const Pages& pages = prepared.atlas.pages;
    Json rows = Json::array();
    for (std::size_t k = 0; k < written.maps.size(); ++k) {
        const NamedLamp& lamp = lamps.lamps[k];
        for (int page = 0; page < pages.count; ++page) {
            written.files.push_back(page_name(pages, page, names[k]) + ".exr");
            write_exr(folder.path(written.files.back()), cut_page(pages, page, written.maps[k]),
                      options.half ? Precision::float16 : Precision::float32,
                      map_metadata(prepared.scene));
        }
        const SceneLamp& listed =
            written.in_scene.emplace_back(SceneLamp{.name = lamp.name,
                                                    .kind = lamp.kind,
                                                    .members = lamp.members,
                                                    .color = lamp_colour(lamps.light[k].irradiance),
                                                    .error = lamps.light[k].error,
                                                    .map = &written.maps[k]});
        rows.push_back({{"name", listed.name},
                        {"kind", listed.kind},
                        {"members", listed.members},
                        {"unit", "lx"},
                        {"color", json_array(listed.color)},
                        {"error", listed.error},
                        {"map", page_name(pages, 0, names[k]) + ".exr"}});
    }
    Json list = {{"lamps", rows}};
    // Half precision rounds each map and the lightmap.
    if (!options.half)
        list["sum_error"] = apart;
    write_json(folder.path(kLampsFile), list);
    written.files.emplace_back(kLampsFile);
    stages.tell(
        fmt::format("{} {} up to the lightmap within {}", written.maps.size(),
                    written.maps.size() == 1 ? "lamp, whose map adds" : "lamps, whose maps add",
                    options.half ? "half precision" : fmt::format("{:.1e} of it", apart)));
    return written;
}

void outdate_apart(OutputFolder& folder, const std::string& target)
{
    std::vector<std::string> files;
    try {
        const Json report = read_json((std::filesystem::path(target) / kReportFile).string());
        files = report.at("files").get<std::vector<std::string>>();
    } catch (const std::exception&) {
        return;  // no bake, or none whose files are known
    }
    const auto is_map = [](const std::string& file) {
        return file.ends_with(".exr") &&
               (file.starts_with(kLampPrefix) || file.starts_with(kDaylightPrefix));
    };
    for (const std::string& file : files)
        if (file == kLampsFile || file == kDaylightFile || is_map(file))
            folder.outdate(file);
}

}  // namespace lumel
