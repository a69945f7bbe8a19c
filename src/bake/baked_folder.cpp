#include "bake/baked_folder.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "bake/solution_file.h"
#include "core/number.h"
#include "scene/gltf_files.h"
#include "solve/methods.h"

namespace lumel {
namespace {

using Json = nlohmann::ordered_json;

std::string setting(const BakedFolder& baked, const std::string& name)
{
    for (const auto& [key, value] : baked.settings)
        if (key == name)
            return value;
    return {};
}

/// Was a setting another than `plain`, which old reports leave out?
bool differs(const BakedFolder& baked, const char* name, const std::string& plain)
{
    const std::string value = setting(baked, name);
    return !value.empty() && value != plain;
}

double number_in(const BakedFolder& baked, const std::string& name)
{
    return number_of(setting(baked, name)).value_or(0.0);
}

[[noreturn]] void refuse(const std::string& folder, const std::string& what)
{
    throw Error(ErrorKind::input, folder, what);
}

void read_report(const std::string& path, BakedFolder& baked)
{
    const Bytes bytes = read_file(path, path);
    const Json report = Json::parse(bytes.begin(), bytes.end());
    for (const auto& [name, value] : report.at("settings").items())
        baked.settings.emplace_back(name, value.get<std::string>());
    baked.scene_hash = report.at("scene").at("hash").get<std::string>();
    const Json& solution = report.at("solution");
    baked.method = solution.at("method").get<std::string>();
    baked.seed = solution.at("seed").get<std::uint32_t>();
    baked.shots = solution.at("shots").get<std::uint64_t>();
    baked.iterations = solution.at("iterations").get<std::uint64_t>();
    baked.error = solution.value("estimated_error", -1.0);
    baked.texels_per_metre = report.at("sizes").at("texels_per_metre").get<double>();
}

}  // namespace

BakedFolder read_baked_folder(const std::string& folder)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (const char* file : {"report.json", "scene.glb", kSolutionFile})
        if (!fs::is_regular_file(fs::path(folder) / file, ignored))
            refuse(folder, std::string("has no ") + file +
                               ": it is not the folder of a finished lumel bake; bake it first");
    BakedFolder baked;
    const std::string report = (fs::path(folder) / "report.json").string();
    try {
        read_report(report, baked);
    } catch (const nlohmann::json::exception&) {
        refuse(report, "is not as lumel bake wrote it; bake it again");
    }
    baked.lights = light_options_of(baked.settings);
    baked.gutter = int(number_in(baked, "gutter"));
    baked.sky_directions = std::uint32_t(number_in(baked, "sky-directions"));
    baked.centre = setting(baked, "sampling") == "centre";
    baked.half = setting(baked, "half") == "true";
    return baked;
}

void check_whole(const std::string& folder, const BakedFolder& baked)
{
    if (differs(baked, "only", "all"))
        refuse(folder, "holds a part of the light, of which no more can be told; bake it again "
                       "without --only");
}

void check_correctable(const std::string& folder, const BakedFolder& baked)
{
    if (method_of(baked.method).materials == MaterialModel::glossy)
        refuse(folder, "was baked with gloss, which cannot be corrected yet; bake it again");
    if (differs(baked, "directional", "none"))
        refuse(folder, "has directional layers, which cannot be corrected yet; bake it again");
    check_whole(folder, baked);
}

}  // namespace lumel
