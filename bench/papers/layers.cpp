// [TN11] figures 2, 7 and 8: illumination maps, the chance that a surface is among the lookups, and
// how much red light a stack of planes leaks onto one that can see no red.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/layer_pictures.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "methods/directions/slabs.h"
#include "raster/parallel/illumination_maps.h"
#include "raster/world/tiles.h"
#include "rays/paths/samples.h"
#include "scene/sky/light_options.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

/// Distance of the planes of a stack, whose sides are 1 m [m].
constexpr float kGap = 0.1f;
/// Side of the picture of a plane [pixels].
constexpr int kPlanePicture = 160;
/// Side of the atlas of a stack of planes [texels].
constexpr int kStackAtlas = 64;
/// Lookups to each side of a pixel: 9 and 25 in all, as in figure 7.
constexpr int kReaches[] = {1, 2};

struct Variant {
    const char* name;
    Layers layers;
    int lookups;
    std::uint32_t slabs = 1;
};

constexpr Variant kVariants[] = {{"stochastic, 1 × 1", Layers::stochastic, 1},
                                 {"1 × 1, 2 slabs", Layers::stochastic, 1, 2},
                                 {"1 × 1, 4 slabs", Layers::stochastic, 1, 4},
                                 {"1 × 1, 8 slabs", Layers::stochastic, 1, 8},
                                 {"stochastic, 3 × 3", Layers::stochastic, 3},
                                 {"3 × 3, 2 slabs", Layers::stochastic, 3, 2},
                                 {"3 × 3, 4 slabs", Layers::stochastic, 3, 4},
                                 {"stochastic, 5 × 5", Layers::stochastic, 5},
                                 {"5 × 5, 2 slabs", Layers::stochastic, 5, 2},
                                 {"list", Layers::list, 1},
                                 {"peel", Layers::peel, 1}};

/// Copies of one plane, behind one another.
Scene stack_of(int planes)
{
    Scene scene;
    scene.path = "stack of planes";
    Material white{.name = "white"};
    white.double_sided = true;
    Primitive plane;
    plane.positions = {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}};
    plane.indices = {0, 1, 2, 0, 2, 3};
    scene.materials = {white};
    scene.meshes = {{"plane", {plane}}};
    for (int k = 0; k < planes; ++k) {
        Instance instance{.name = "plane"};
        instance.transform[3].y = float(k) * kGap;
        scene.instances.push_back(instance);
    }
    return scene;
}

/// Illumination maps of planes, one of each slab: which of them each pixel shows, -1: none.
struct PlaneMaps {
    int side = 0;
    std::vector<std::vector<int>> slabs;

    int at(std::size_t slab, int x, int y) const
    {
        return slabs[slab][std::size_t(y) * std::size_t(side) + std::size_t(x)];
    }
};

/// Marks the planes that a pixel shows. Returns whether there is any.
bool mark_planes(const PlaneMaps& maps, int x, int y, std::vector<bool>& seen)
{
    bool any = false;
    for (std::size_t slab = 0; slab < maps.slabs.size(); ++slab) {
        const int plane = maps.at(slab, x, y);
        if (plane < 0)
            continue;
        any = true;
        seen[std::size_t(plane)] = true;
    }
    return any;
}

/// Part of the pixels around which `reach` to each side show a plane; mean over planes. Pixels
/// whose neighbourhood leaves the stack do not count.
double share_found(const PlaneMaps& maps, int planes, int reach)
{
    std::size_t found = 0, pixels = 0;
    for (int y = reach; y < maps.side - reach; ++y)
        for (int x = reach; x < maps.side - reach; ++x) {
            std::vector<bool> seen(std::size_t(planes), false);
            bool inside = true;
            for (int v = y - reach; v <= y + reach; ++v)
                for (int u = x - reach; u <= x + reach; ++u)
                    inside = mark_planes(maps, u, v, seen) && inside;
            if (!inside)
                continue;
            ++pixels;
            found += std::size_t(std::count(seen.begin(), seen.end(), true));
        }
    return double(found) / (double(pixels) * double(planes));
}

PlaneMaps read_maps(const IlluminationMaps& maps, const Lumels& lumels)
{
    std::vector<int> plane_of(std::size_t(lumels.width) * std::size_t(lumels.height), -1);
    for (const Lumel& lumel : lumels.lumels)
        plane_of[lumel.texel] = int(lumel.instance);
    const gpu::Target& image = maps.image();
    std::vector<glm::uvec4> pixels(std::size_t(image.width()) * image.height());
    image.download(pixels.data());
    PlaneMaps read{int(maps.layout().side), {}};
    for (std::uint32_t slab = 0; slab < maps.slabs(); ++slab) {
        const gpu::Area area = tiles_of(maps.layout()).area(slab);
        std::vector<int>& planes = read.slabs.emplace_back();
        for (std::uint32_t y = area.y; y < area.y + area.height; ++y)
            for (std::uint32_t x = area.x; x < area.x + area.width; ++x) {
                const std::uint32_t surface = pixels[std::size_t(y) * image.width() + x].x;
                planes.push_back(surface == 0 ? -1 : plane_of[(surface - 1) / 2]);
            }
    }
    return read;
}

/// Views straight down on the planes, turned and shifted by chance.
std::vector<ParallelView> views_from_above(const World& world, int side, int count,
                                           std::uint32_t seed)
{
    std::vector<ParallelView> views;
    for (int i = 0; i < count; ++i) {
        const PathSamples samples(seed, std::uint32_t(i));
        views.push_back(fit_view(world.low(), world.high(), std::uint32_t(side),
                                 {.turn = 2.0f * std::numbers::pi_v<float> * samples.random(0).x,
                                  .offset = samples.random(1),
                                  .random = samples.bits(0)}));
    }
    return views;
}

struct Chances {
    double overdraw = 0.0;      ///< K as it is measured, see Overdraw
    std::vector<double> found;  ///< for each reach, the share of the planes
};

/// In maps of a number of planes.
Chances measure_chances(const LayersSettings& settings, const gpu::Device& device, int planes,
                        int slabs)
{
    const auto shared = options_of<DirectionsOptions>(settings.shared);
    const SolveScene world(stack_of(planes), AtlasOptions{.size = kStackAtlas});
    const World resident(device, world.scene, world.lumels, &world.atlas);
    IlluminationMaps maps(device, resident, Layers::stochastic, std::uint32_t(shared.map_side), 1,
                          std::uint32_t(world.lumels.width), std::uint32_t(world.lumels.height),
                          std::uint32_t(slabs));
    const std::vector<ParallelView> poses =
        views_from_above(resident, shared.map_side, settings.views, shared.seed);
    const gpu::Array<ParallelView> views(device, std::span<const ParallelView>(poses));
    gpu::Pacer pacer(device);
    Chances chances{.found = std::vector<double>(std::size(kReaches), 0.0)};
    for (std::uint32_t i = 0; i < std::uint32_t(poses.size()); ++i) {
        maps.look_along(pacer, views, i, 1);
        pacer.finish();
        const PlaneMaps read = read_maps(maps, world.lumels);
        for (std::size_t r = 0; r < chances.found.size(); ++r)
            chances.found[r] += share_found(read, planes, kReaches[r]) / double(poses.size());
        chances.overdraw += maps.overdraw(1) / double(poses.size());
    }
    return chances;
}

/// C_n(K), where planes are shared out evenly among slabs.
double expected_chance(double planes, int reach)
{
    return chance_found(planes, (2 * reach + 1) * (2 * reach + 1));
}

void add_chances(Report& report, const LayersSettings& settings, const gpu::Device& device)
{
    report.table("chances",
                 fmt::format("Surfaces found among the lookups ([TN11] figure 7), {} maps of {}²",
                             settings.views,
                             options_of<DirectionsOptions>(settings.shared).map_side),
                 {"planes", "slabs", "K measured", "9 lookups, found %", "1 − (1 − 1/K)⁹, %",
                  "25 lookups, found %", "1 − (1 − 1/K)²⁵, %"},
                 kTracesRays);
    std::array<double, std::size(kReaches)> farthest{};  // from the formula, without slabs
    for (const int slabs : settings.slabs)
        for (const int planes : settings.overdraws) {
            if (planes % slabs != 0)
                continue;
            const Chances chances = measure_chances(settings, device, planes, slabs);
            const double shared = double(planes) / double(slabs);
            std::vector<Cell> cells{planes, slabs, fixed(chances.overdraw, 2)};
            for (std::size_t r = 0; r < farthest.size(); ++r) {
                const double found = 100.0 * chances.found[r];
                const double expected = 100.0 * expected_chance(shared, kReaches[r]);
                cells.push_back(fixed(found, 2));
                cells.push_back(fixed(expected, 2));
                if (slabs == 1)
                    farthest[r] = std::max(farthest[r], std::abs(found - expected));
            }
            report.row(cells);
        }
    report.table("chance-errors", "Farthest from the formula, one slab",
                 {"lookups", "percentage points"}, kTracesRays);
    report.row({9, fixed(farthest[0], 3)});
    report.row({25, fixed(farthest[1], 3)});
}

/// What the plane on top receives on one side: by how much the red exceeds the green, as a part
/// of it.
double red_error(const SolveScene& world, const std::vector<glm::vec3>& irradiance,
                 std::uint32_t side)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        if (world.scene.instances[lumel.instance].name == "top" &&
            (lumel.flags & kLumelBack) == side)
            sum += double(lumel.area) * glm::dvec3(irradiance[i]);
    }
    return (sum.r - sum.g) / sum.g;
}

/// Of the paper's three filters and of exact layers.
bool is_pictured(const Variant& variant)
{
    return variant.layers != Layers::peel && variant.slabs == 1;
}

void add_picture(Report& report, const LayersSettings& settings, const char* name,
                 const Image& picture, const char* caption)
{
    const std::string path = settings.folder + name;
    write_png(path, picture);
    report.picture(path, caption);
}

void add_red(Report& report, const LayersSettings& settings, const gpu::Device& device,
             const SolveScene& world)
{
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const Solved ours = solve_by_default(device, world);
    report.table("red", "Red light that leaks onto the plane on top ([TN11] figure 8)",
                 {"layers", "red error above, %", "below, %", "wall ms per direction", "cpu ms"},
                 words_of(red_error(world, ours.irradiance, kLumelBack), ours.cpu));
    std::vector<Image> planes;
    for (const Variant& variant : kVariants) {
        auto options = options_of<DirectionsOptions>(settings.shared);
        options.layers = variant.layers;
        options.lookups = variant.lookups;
        options.slabs = variant.slabs;
        const NearField none = no_near_field(world.lumels);
        const auto solver =
            make_solver({&device, &resident, world.lumels, none}, papers_iteration(options));
        solver->step();
        solver->irradiance();  // the driver compiles shaders when they first run
        Stopwatch watch;
        watch.start();
        const std::uint64_t before = solver->state().shots;
        while (solver->state().shots < std::uint64_t(settings.directions))
            solver->step();
        const std::vector<glm::vec3> irradiance = solver->irradiance();
        watch.stop();
        const double directions = double(solver->state().shots - before);
        report.row({variant.name, fixed(100.0 * red_error(world, irradiance, 0), 2),
                    fixed(100.0 * red_error(world, irradiance, kLumelBack), 2),
                    fixed(1e3 * watch.wall / directions, 2),
                    fixed(1e3 * watch.cpu / directions, 2)});
        if (is_pictured(variant))
            planes.push_back(plane_on_top(world, irradiance, kPlanePicture));
    }
    if (!settings.folder.empty())
        add_picture(report, settings, "/leaks.png", tone_map(contact_sheet({planes})),
                    "The plane on top from below, [TN11] figure 8: 1 × 1, 3 × 3 and 5 × 5 lookups, "
                    "and lists, which leak nothing");
}

}  // namespace

void measure_layers(const LayersSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const Settings& shared = settings.shared;
    const int map_side = options_of<DirectionsOptions>(shared).map_side;
    LightOptions white;
    white.sky_color = glm::vec3(1.0f);
    const SolveScene world(read_scene(shared.scene, MaterialModel::diffuse, white),
                           AtlasOptions{.size = shared.size});
    report.say(fmt::format("{}, {} lumels at {}², {} directions, maps of {}², {}", shared.scene,
                           world.lumels.lumels.size(), world.atlas.width, settings.directions,
                           map_side, words_of(device)));
    if (!settings.folder.empty()) {
        std::filesystem::create_directories(settings.folder);
        add_picture(report, settings, "/illumination-map.png",
                    four_cubes_along_a_direction(settings, device),
                    "Four cubes along one direction, [TN11] figure 2: the illumination map, with "
                    "black backs; the surfaces behind each pixel, the more the darker");
    }
    add_red(report, settings, device, world);
    add_chances(report, settings, device);
    device.check_validation();
}

}  // namespace lumel::bench
