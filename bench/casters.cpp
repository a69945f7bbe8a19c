// How fast rays are cast by the host and by the device.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include <unistd.h>

#include <fmt/core.h>

#include "atlas/near/world_lumels.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "base/core/sphere.h"
#include "base/json/json_file.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"
#include "gpu/commands.h"
#include "jobs/bake/bake.h"
#include "rays/device/device_caster.h"
#include "rays/device/device_caster.tree.comp.h"
#include "rays/device/flat_tree.h"
#include "rays/paths/samples.h"

namespace lumel::bench {
namespace {

/// Rays of a run.
constexpr std::size_t kRays = std::size_t(1) << 21;
/// Rays per lumel of a bake.
constexpr std::uint64_t kBakedRays = 48;
/// Runs of each caster, of which the fastest counts.
constexpr int kTimes = 3;

/// Rounding of distances [m], and of each metre beyond the first.
constexpr float kRounding = 1e-5f;

/// Rays out of lumels, distributed by the cosine of their angle to the normal.
std::vector<RaySpan> diffuse_rays(const SolveScene& world)
{
    const WorldLumels lumels(world.scene, world.rays, world.lumels);
    const std::size_t count = world.lumels.lumels.size();
    std::vector<RaySpan> rays(kRays);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const WorldLumel& from = lumels[std::size_t(i) * count / kRays];
        rays[i] = ray_out(from.centre + from.ray_offset * from.normal,
                          frame_about(from.normal) * by_cosine(PathSamples(1, i).random(0)), i);
    }
    return rays;
}

bool meets_the_same(const RayHit& one, const RayHit& other)
{
    return one.distance == other.distance ||
           std::abs(one.distance - other.distance) <= kRounding * (1.0f + one.distance);
}

void print_rate(const std::string& name, double seconds, const std::string& note)
{
    fmt::print("{:<28} {:>10.1f}  {}\n", name, 1e-6 * double(kRays) / seconds, note);
}

/// As links are traced: batches on all cores, with everything that a hit says.
std::vector<RayHit> time_caster(const RayCaster& caster, const std::vector<RaySpan>& rays,
                                const std::vector<RayHit>& by_host)
{
    std::vector<RayHit> hits(rays.size());
    const double seconds = fastest(kTimes, [&] {
        parallel_for(rays.size() / caster.batch(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) {
                const std::size_t begin = n * caster.batch(), count = caster.batch();
                caster.closest(std::span(rays).subspan(begin, count),
                               std::span(hits).subspan(begin, count));
            }
        });
    });
    std::size_t other = 0;
    for (std::size_t i = 0; i < by_host.size(); ++i)
        other += !meets_the_same(hits[i], by_host[i]);
    print_rate(caster.name(), seconds,
               by_host.empty() ? "" : fmt::format("{} rays end elsewhere than the host's", other));
    return hits;
}

/// The shader alone: rays lie on the device, and hits stay there.
void time_shader(const gpu::Device& device, const SolveScene& world,
                 const std::vector<RaySpan>& rays)
{
    const DeviceTriangles numbering(world.rays);
    const FlatTree tree = build_flat_tree(numbering.mesh(world.rays));
    std::vector<CastRay> asked(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        asked[i] = {rays[i].origin, rays[i].near, rays[i].direction, rays[i].far};
    const gpu::Array<TreeNode> nodes(device, tree.nodes);
    const gpu::Array<TreeTriangle> triangles(device, tree.triangles);
    const gpu::Array<CastRay> given(device, asked);
    const gpu::Array<CastHit> hits(device, rays.size());
    const gpu::Kernel<shaders::DeviceCasterTree> cast(device);
    gpu::Commands commands(device);
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < kTimes; ++n) {
        commands.dispatch(
            cast,
            {.nodes = gpu::packed(nodes),
             .triangles = gpu::packed(triangles),
             .rays = given,
             .hits = hits},
            {.rays = std::uint32_t(rays.size()), .wanted = kNearest, .solid = numbering.solid()},
            rays.size());
        commands.run();
        best = std::min(best, 1e-3 * commands.last_milliseconds());
    }
    print_rate("tree, without transfers", best,
               fmt::format("{} nodes, {} triangles", tree.nodes.size(), tree.triangles.size()));
}

/// Prints the wall time of a bake and of its stages, with rays cast in one way.
void time_bake(const Settings& settings, const std::string& name, Rays rays)
{
    BakeOptions options;
    options.lights = settings.lights;
    options.atlas.size = settings.size;
    options.device = settings.device;
    options.preview_width = 0;
    options.solver = {
        .method = LinksOptions{.rays = rays}, .max_shots = kBakedRays, .target_error = 0.0};
    const auto folder =
        std::filesystem::temp_directory_path() / fmt::format("lumel-bench-casters-{}", getpid());
    const Json timings =
        Json::parse(bake(settings.scene, folder.string(), options).report)["timings"];
    std::filesystem::remove_all(folder);
    const auto stage = [&](const char* of) {
        return timings["gpu"].contains(of) ? 1e-3 * timings["gpu"][of]["total_ms"].get<double>()
                                           : 0.0;
    };
    fmt::print("{:<28} {:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f}\n", name, stage("direct light"),
               stage("links"), stage("sweeps"), timings["wall_seconds"].get<double>());
}

}  // namespace

void time_casters(const Settings& settings)
{
    if (!settings.lamp.empty() || !settings.box.empty())
        throw Error(ErrorKind::input, "--casters",
                    "bakes the scene as it is, without --lamp or --box");
    const SolveScene world = prepare(settings, settings.size);
    if (world.lumels.lumels.empty())
        throw Error(ErrorKind::input, settings.scene, "has no surfaces that rays could leave");
    const gpu::Device device(settings.device);
    fmt::print("{} at {}: {} lumels; device: {} ({})\n", settings.scene, settings.size,
               world.lumels.lumels.size(), device.info().name, device.info().driver);
    const std::vector<RaySpan> rays = diffuse_rays(world);
    fmt::print("{:<28} {:>10}\n", "diffuse first hits by", "Mrays/s");
    const std::vector<RayHit> by_host = time_caster(*cast_on_host(world.rays), rays, {});
    if (device.can_query_rays())
        time_caster(*cast_by_queries(device, world.rays), rays, by_host);
    time_caster(*cast_by_tree(device, world.rays), rays, by_host);
    time_shader(device, world, rays);
    time_sweeps(device, world);

    fmt::print("\n{:<28} {:>10} {:>10} {:>10} {:>10}\n",
               fmt::format("bakes with {} rays [s]", kBakedRays), "direct", "links", "sweeps",
               "whole");
    time_bake(settings, "host", Rays::host);
    if (device.can_query_rays())
        time_bake(settings, "query", Rays::query);
    time_bake(settings, "tree", Rays::tree);
}

}  // namespace lumel::bench
