// What a bake is said to take of the device's memory is what it takes.

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "base/json/json_file.h"
#include "jobs/bake/bake.h"
#include "methods/methods.h"
#include "solved.h"

namespace lumel {
namespace {

/// Parts of the peak that what was said may be off by.
constexpr double kAlike = 0.25;

BakeOptions small(std::string_view method)
{
    BakeOptions options;
    options.atlas.size = 96;
    options.solver.method = method_of(method).defaults();
    set_option(options.solver.method, "hemicube", "64");
    set_option(options.solver.method, "patches", "64");
    options.solver.max_shots = 64;
    options.solver.target_error = 0.0;
    options.preview_width = 0;
    return options;
}

void expect_as_described(const std::string& scene, const BakeOptions& options)
{
    const test::TemporaryFolder folder;
    const std::string path = support::scene_path(scene);
    const Json report = Json::parse(bake(path, folder / "out", options).report);
    const Json said = Json::parse(describe(path, options, true));
    const auto peak = report["memory"]["peak_gpu_bytes"].get<double>();
    EXPECT_NEAR(said["graphics_memory_bytes"].get<double>(), peak, kAlike * peak)
        << method_of(options.solver.method).id << " in " << scene << ": "
        << said["graphics_memory_parts"];
}

TEST(GraphicsMemory, OfEveryMethodIsAsDescribed)
{
    for (const MethodInfo& method : methods())
        expect_as_described("cornell-box", small(method.id));
}

TEST(GraphicsMemory, OfRaysOnTheDeviceIsAsDescribed)
{
    BakeOptions options = small("links");
    set_option(options.solver.method, "rays", "tree");
    expect_as_described("cornell-box", options);
}

TEST(GraphicsMemory, OfDirectionalLayersIsAsDescribed)
{
    BakeOptions options = small(methods().front().id);
    options.directional = Directional::sh2;
    expect_as_described("cornell-box", options);
}

TEST(GraphicsMemory, OfSkyAndLampsIsAsDescribed)
{
    BakeOptions options = small("stochastic");
    set_sky(options.lights, "1,1,1");
    options.sky_directions = 16;
    expect_as_described("cornell-box", options);
}

}  // namespace
}  // namespace lumel
