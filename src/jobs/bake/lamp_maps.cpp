#include "jobs/bake/lamp_maps.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/error.h"
#include "base/core/parallel.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "results/record/bake_record.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

constexpr const char* kLampPrefix = "lamp-";
/// Maximum length of a lamp's name in a file name [bytes].
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kTexelsPerTask = 4096;
/// For the difference of the sum, texels darker than this × the brightest count as that bright.
constexpr float kDarkestCounted = 1e-6f;

/// A name without what file systems, shells and web addresses treat specially.
std::string as_file_name(const std::string& name)
{
    std::string safe = name.substr(0, kLongestName);
    for (char& letter : safe) {
        const auto byte = static_cast<unsigned char>(letter);
        const bool is_plain = (letter >= 'a' && letter <= 'z') ||
                              (letter >= 'A' && letter <= 'Z') ||
                              (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
        if (!is_plain && byte < 0x80)
            letter = '_';
    }
    // Not a part of a letter at the end.
    if (name.size() > safe.size())
        while (!safe.empty() && (static_cast<unsigned char>(safe.back()) & 0x80u) != 0)
            safe.pop_back();
    return safe;
}

/// Largest difference between the sum of the maps and the whole, relative to the whole.
double error_of_sum(const Image& whole, const std::vector<Image>& maps)
{
    const float brightest = *std::ranges::max_element(whole.values);
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

/// Colour of the light that a lamp gives to all lumels, its largest channel 1.
glm::dvec3 colour_of(const std::vector<glm::vec3>& irradiance)
{
    glm::dvec3 sum(0.0);
    for (const glm::vec3& light : irradiance)
        sum += glm::dvec3(light);
    const double most = std::max({sum.r, sum.g, sum.b});
    return most > 0.0 ? sum / most : glm::dvec3(1.0);
}

}  // namespace

void check_per_lamp(const BakeOptions& options, bool wanted)
{
    if (wanted && !std::holds_alternative<LinksOptions>(options.solver.method))
        throw Error(ErrorKind::input, "--per-lamp with another solver",
                    "is not possible: only --solver links keeps the light of lamps apart");
}

std::vector<Image> lamp_maps(const SolveScene& prepared, std::span<const glm::vec3> irradiance,
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
                     for (std::size_t v = 4 * from; v < 4 * to; ++v) {
                         if (v % 4 == 3)
                             continue;
                         float sum = 0.0f;
                         for (Image& map : finished.layers)
                             sum += map.values[v] = std::max(map.values[v], 0.0f);
                         const float whole = finished.light.values[v];
                         for (Image& map : finished.layers)
                             map.values[v] = sum > 0.0f ? map.values[v] * (whole / sum)
                                                        : whole / float(finished.layers.size());
                     }
                 });
    return std::move(finished.layers);
}

std::vector<std::string> lamp_map_names(const std::vector<NamedLamp>& lamps)
{
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const NamedLamp& lamp : lamps) {
        const std::string plain = kLampPrefix + as_file_name(lamp.name);
        std::string name = plain;
        for (int number = 2; !taken.insert(name).second; ++number)
            name = plain + "_" + std::to_string(number);
        names.push_back(name);
    }
    return names;
}

std::vector<std::string> write_lamps(const OutputFolder& folder, const BakeOptions& options,
                                     const SolveScene& prepared,
                                     std::span<const glm::vec3> irradiance, const LampLights& lamps,
                                     Stages& stages)
{
    const std::vector<Image> maps = lamp_maps(prepared, irradiance, lamps.light);
    const std::vector<std::string> names = lamp_map_names(lamps.lamps);
    const Pages& pages = prepared.atlas.pages;
    std::vector<std::string> files;
    Json rows = Json::array();
    for (std::size_t k = 0; k < maps.size(); ++k) {
        const NamedLamp& lamp = lamps.lamps[k];
        for (int page = 0; page < pages.count; ++page) {
            files.push_back(page_name(pages, page, names[k]) + ".exr");
            write_exr(folder.path(files.back()), cut_page(pages, page, maps[k]),
                      options.half ? Precision::float16 : Precision::float32,
                      {{"quantity", "irradiance"},
                       {"unit", "lx"},
                       {"colorSpace", "linear Rec. 709"},
                       {"alpha", "coverage"},
                       {"sceneHash", prepared.scene.hash},
                       {"software", "lumel " + lumel_version()}});
        }
        rows.push_back({{"name", lamp.name},
                        {"kind", lamp.kind},
                        {"members", lamp.members},
                        {"unit", "lx"},
                        {"color", json_array(colour_of(lamps.light[k].irradiance))},
                        {"error", lamps.light[k].error},
                        {"map", page_name(pages, 0, names[k]) + ".exr"}});
    }
    const Image whole = finish_map(prepared.scene, prepared.atlas, prepared.lumels, irradiance);
    const double apart = error_of_sum(whole, maps);
    write_json(folder.path(kLampsFile), {{"lamps", rows}, {"sum_error", apart}});
    files.emplace_back(kLampsFile);
    stages.tell(fmt::format("{} lamps, whose maps add up to the lightmap within {:.1e} of it",
                            maps.size(), apart));
    return files;
}

void outdate_lamps(OutputFolder& folder, const std::string& target)
{
    const std::string list = (std::filesystem::path(target) / kLampsFile).string();
    folder.outdate(kLampsFile);
    try {
        if (!std::filesystem::exists(list))
            return;
        const Json json = read_json(list);
        for (const Json& lamp : json.at("lamps")) {
            const std::string first = lamp.at("map").get<std::string>();
            if (!first.starts_with(kLampPrefix))
                continue;
            folder.outdate(first);
            const std::size_t page = first.rfind("-0.exr");
            for (int k = 1; page != first.npos && k < kMaxPages; ++k)
                folder.outdate(first.substr(0, page) + "-" + std::to_string(k) + ".exr");
        }
    } catch (const std::exception&) {
        return;  // not a list of lamps: its maps are not ours to remove
    }
}

}  // namespace lumel
