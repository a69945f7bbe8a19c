// [BJ04] figures 7 and 8: "a single iteration requires 120-150 msec for ten to ten thousand
// vertices and for 512 · 512 resolution radiosity maps".

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "bench/cut.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/our_default.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

/// Edges are cut into this number of pieces at most.
constexpr int kMaxPieces = 256;

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
    for (int pieces = 1; pieces <= kMaxPieces; ++pieces)
        if (std::abs(triangles * grid_points(pieces) - vertices) <
            std::abs(triangles * grid_points(best) - vertices))
            best = pieces;
    return cut(kept, best);
}

void add_row(Report& report, int size, std::size_t lumels, const Scene& scene,
             const IterationCost& cost, const Solved& ours)
{
    const auto ms = [&](std::initializer_list<const char*> stages) {
        return fixed(sum_of(cost.stages, stages), 2);
    };
    report.row({fmt::format("{}²", size), lumels, drawn_vertices(scene),
                find_occluders(scene).inner_indices().size() / 3, fixed(cost.cpu_ms, 2),
                fixed(cost.wall_ms, 2), ms({"select"}), ms({"power"}), ms({"look"}),
                ms({"receive"}), ms({"advance"}), ms({"other", "figures", "polish"}),
                cost.recorded.dispatches, cost.recorded.passes, cost.recorded.draws},
               fmt::format("whole map, {:.2f} s", ours.cpu));
}

/// The costs of one map, for each number of vertices.
using Costs = std::vector<IterationCost>;

double slowest_to_fastest(const Costs& costs, double IterationCost::*ms)
{
    const auto [fastest, slowest] = std::minmax_element(
        costs.begin(), costs.end(), [ms](const auto& a, const auto& b) { return a.*ms < b.*ms; });
    return (*slowest).*ms / ((*fastest).*ms);
}

/// What the papers state in words.
void add_summary(Report& report, const IterationSettings& settings, const std::vector<Costs>& maps,
                 bool by_processor)
{
    const auto ms = by_processor ? &IterationCost::cpu_ms : &IterationCost::wall_ms;
    report.table("summary", by_processor ? "In short, processor time" : "In short, wall time",
                 {"what", "maps", "value"}, "no iterations");
    report.row({"slowest / fastest number of vertices", fmt::format("{}²", settings.sizes.back()),
                fixed(slowest_to_fastest(maps.back(), ms), 2)});
    // "a few hundred vertices"
    const std::size_t few = std::min<std::size_t>(1, settings.vertices.size() - 1);
    if (maps.size() > 1)
        report.row({"gain by the smaller map, %",
                    fmt::format("{}² for {}²", settings.sizes[0], settings.sizes[1]),
                    fixed(100.0 * (maps[1][few].*ms / (maps[0][few].*ms) - 1.0), 0)});
    const gpu::Recorded& recorded = maps[std::min<std::size_t>(1, maps.size() - 1)][few].recorded;
    report.row({"dispatches and passes",
                fmt::format("{}²", settings.sizes[std::min<std::size_t>(1, maps.size() - 1)]),
                recorded.dispatches + recorded.passes});
}

}  // namespace

void time_iterations(const IterationSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const SolverOptions options = papers_iteration(settings.shared.given.options());
    report.say(fmt::format(
        "{}, {} of side {}, {}", settings.shared.scene,
        views_of(options.method).projection == Projection::hemisphere ? "hemispheres" : "hemicubes",
        views_of(options.method).hemicube, words_of(device)));
    report.table("iterations", "Time of an iteration ([BJ04] figures 7 and 8); stages: device, ms",
                 {"map", "lumels", "vertices", "triangles", "cpu ms", "wall ms", "select",
                  "pyramid", "depth map", "receive", "average", "else", "dispatches", "passes",
                  "draws"},
                 none());
    std::vector<Costs> maps;
    for (const int size : settings.sizes) {
        maps.emplace_back();
        const SolveScene world = prepare(settings.shared, size);
        const Solved ours = solve_by_default(device, world);
        for (const int vertices : settings.vertices) {
            const Scene scene = drawn_with(world.scene, vertices);
            const World resident(device, scene, world.lumels);
            const NearField none = no_near_field(world.lumels);
            const auto solver = make_solver({&device, &resident, world.lumels, none}, options);
            maps.back().push_back(cost_of_iteration(device, *solver, settings.iterations));
            add_row(report, size, world.lumels.lumels.size(), scene, maps.back().back(), ours);
        }
    }
    add_summary(report, settings, maps, counts_processor_time(device));
    device.check_validation();
}

}  // namespace lumel::bench
