// lumel compare: how far one map is from another, in figures and as a picture.

#include <filesystem>

#include <fmt/core.h>

#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "commands.h"
#include "truth/metrics.h"

namespace lumel {
namespace {

/// Beside the map that is measured.
std::string default_heat_map(const CompareArguments& arguments)
{
    const std::filesystem::path map = arguments.map, reference = arguments.reference;
    return map.parent_path() / (map.stem().string() + "-vs-" + reference.stem().string() + ".png");
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
