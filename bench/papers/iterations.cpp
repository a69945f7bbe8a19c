// [BJ04] figures 7 and 8: "a single iteration requires 120-150 msec for ten to ten thousand
// vertices and for 512 · 512 resolution radiosity maps".

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/core.h>

#include "bench/cut.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "solve/solver.h"

namespace lumel::bench {
namespace {

/// Edges are cut into this number of pieces at most.
constexpr int kMostPieces = 256;

/// The scene without what is in the room: its blocks stay only as lumels.
Scene without_blocks(Scene scene)
{
    for (const Instance& instance : scene.instances)
        if (instance.name.find("block") != std::string::npos)
            for (Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
                primitive.indices.clear();
    return scene;
}

/// Corners of the triangles that are drawn, each once.
std::size_t drawn_vertices(const Scene& scene)
{
    std::vector<std::uint32_t> indices = find_occluders(scene).inner_indices();
    std::sort(indices.begin(), indices.end());
    return std::size_t(std::unique(indices.begin(), indices.end()) - indices.begin());
}

/// Vertices of a triangle whose edges are cut into a number of pieces.
double grid_points(int pieces)
{
    return 0.5 * (pieces + 1.0) * (pieces + 2.0);
}

/// The scene drawn with about a given number of vertices. Triangles share none once they are cut;
/// where there are too many even so, the blocks go.
Scene drawn_with(const Scene& scene, int vertices)
{
    const bool whole = std::size_t(vertices) >= drawn_vertices(scene);
    const Scene kept = whole ? scene : without_blocks(scene);
    const double triangles = double(find_occluders(kept).inner_indices().size()) / 3.0;
    int best = 1;
    for (int pieces = 1; pieces <= kMostPieces; ++pieces)
        if (std::abs(triangles * grid_points(pieces) - vertices) <
            std::abs(triangles * grid_points(best) - vertices))
            best = pieces;
    return cut(kept, best);
}

void print_head()
{
    fmt::print("| map | lumels | vertices | triangles | cpu ms | wall ms | select | pyramid "
               "| depth map | receive | average | else | dispatches | passes (draws) |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print_row(int size, std::size_t lumels, const Scene& scene, const IterationCost& cost)
{
    const auto ms = [&](const char* stage) { return sum_of(cost.stages, {stage}); };
    const double other = sum_of(cost.stages, {"other", "figures", "polish"});
    fmt::print("| {}² | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} "
               "| {:.2f} | {:.2f} | {} | {} ({}) |\n",
               size, lumels, drawn_vertices(scene),
               find_occluders(scene).inner_indices().size() / 3, cost.cpu_ms, cost.wall_ms,
               ms("select"), ms("power"), ms("look"), ms("receive"), ms("advance"), other,
               cost.recorded.dispatches, cost.recorded.passes, cost.recorded.draws);
    std::fflush(stdout);
}

}  // namespace

void time_iterations(const IterationSettings& settings)
{
    const gpu::Device device(settings.shared.device);
    const SolverOptions options = papers_iteration(settings.shared.given.options());
    fmt::print("{}, {} of side {}, {} ({})\n\n", settings.shared.scene,
               views_of(options.method).projection == Projection::hemisphere ? "hemispheres"
                                                                             : "hemicubes",
               views_of(options.method).hemicube, device.info().name, device.info().driver);
    print_head();
    for (const int size : settings.sizes) {
        const Prepared world = prepare(settings.shared, size);
        for (const int vertices : settings.vertices) {
            const Scene scene = drawn_with(world.scene, vertices);
            const World resident(device, scene, world.lumels);
            const NearField none = no_near_field(world.lumels);
            const auto solver = make_solver({device, &resident, world.lumels, none}, options);
            print_row(size, world.lumels.lumels.size(), scene,
                      cost_of_iteration(device, *solver, settings.iterations));
        }
    }
    device.check_validation();
}

}  // namespace lumel::bench
