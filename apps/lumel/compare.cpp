// lumel compare: how far one map is from another, in figures and as a picture.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/core.h>

#include "base/core/error.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "commands.h"
#include "results/record/bake_record.h"
#include "truth/metrics.h"

namespace lumel {
namespace {

/// Beside the map that is measured.
std::string default_heat_map(const CompareArguments& arguments)
{
    const std::filesystem::path map = arguments.map, reference = arguments.reference;
    return map.parent_path() / (map.stem().string() + "-vs-" + reference.stem().string() + ".png");
}

struct RecordedScene {
    std::string file, hash;
};

/// The scene of a map, by the report of the bake that wrote it; empty without one.
std::optional<RecordedScene> scene_of(const std::string& map)
{
    const std::filesystem::path path = map;
    const std::string report = (path.parent_path() / kReportFile).string();
    if (!std::filesystem::exists(report))
        return std::nullopt;
    std::ifstream stream(report);
    const Json json = Json::parse(stream, nullptr, false);
    const auto text = [](const Json& in, const char* name) {
        return in.is_object() && in.contains(name) && in[name].is_string()
                   ? std::optional(in[name].get<std::string>())
                   : std::nullopt;
    };
    const bool is_record =
        json.is_object() && json.contains("scene") && json.contains("files") &&
        json["files"].is_array() &&
        std::ranges::find(json["files"], Json(path.filename().string())) != json["files"].end();
    if (!is_record)
        return std::nullopt;
    const std::optional<std::string> file = text(json["scene"], "file"),
                                     hash = text(json["scene"], "hash");
    return file && hash ? std::optional(RecordedScene{*file, *hash}) : std::nullopt;
}

/// Refuses bakes of two scenes, unless their charts are the same: those of an edited scene.
void check_scenes(const CompareArguments& arguments, const Image& map, const Image& reference)
{
    const std::optional<RecordedScene> one = scene_of(arguments.map);
    const std::optional<RecordedScene> other = scene_of(arguments.reference);
    if (one && other && one->hash != other->hash && !covers_the_same(map, reference))
        throw Error(ErrorKind::input, arguments.map,
                    "is of " + one->file + " and " + arguments.reference + " is of " + other->file +
                        ": their charts differ, so texels do not correspond; compare two bakes of "
                        "one scene");
}

void print_json(const MapError& error)
{
    fmt::print("{}", json_text({{"relative_rmse", error.relative_rmse},
                                {"rel_mse", error.rel_mse},
                                {"bias", error.bias},
                                {"p95", error.p95},
                                {"max", error.max},
                                {"texels", error.texels}}));
}

void print_table(const MapError& error)
{
    fmt::print("relative RMSE    {:8.3f} %\n", 100.0 * error.relative_rmse);
    fmt::print("relMSE           {:8.6f}\n", error.rel_mse);
    fmt::print("bias             {:+8.3f} %\n", 100.0 * error.bias);
    fmt::print("95th percentile  {:8.3f} %\n", 100.0 * error.p95);
    fmt::print("max              {:8.3f} %\n", 100.0 * error.max);
    fmt::print("texels           {:8}\n", error.texels);
}

}  // namespace

int run(const CompareArguments& arguments)
{
    const Image map = read_exr(arguments.map);
    const Image reference = read_exr(arguments.reference);
    check_scenes(arguments, map, reference);
    const MapError error = compare_maps(map, reference, arguments.most);
    const std::string picture =
        arguments.heat_map.empty() ? default_heat_map(arguments) : arguments.heat_map;
    write_png(picture, heat_map(map, reference));

    if (arguments.json) {
        print_json(error);
    } else {
        print_table(error);
        fmt::print("heat map         {}\n", picture);
    }
    return kExitDone;
}

}  // namespace lumel
