// [TN11] figure 9: example scenes, with the directions and maps of the paper.

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/cut.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/landscape.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "results/preview/preview.h"
#include "scene/sky/clear_sky.h"
#include "solve/solver/solver.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

/// 135,200 triangles.
constexpr int kLandscapeCells = 260;
/// Where the sun, which itself gives no light here, stands in the clear sky.
constexpr SunPosition kSun{.azimuth = 2.2, .elevation = 0.7};
/// Of all pictures, so that they fit one sheet: width / height.
constexpr float kAspect = 1.25f;
constexpr std::size_t kPicturesInRow = 3;

enum class Light { sky, own };

/// A scene of the figure.
struct Example {
    std::string key;  ///< on the command line
    std::string name;
    std::string path;  ///< empty: the landscape
    int directions;
    Light light;
    int pieces = 1;   ///< that triangle edges are cut into, for the paper's number of triangles
    int lookups = 0;  ///< wide and high; 0: as the settings have it
    int finer = 1;    ///< sides of the lightmap, as multiples of the others'
};

/// Empty if there is none.
std::string sponza_file(const DirectionsSettings& settings)
{
    const char* data = std::getenv("LUMEL_DATA");
    if (!settings.sponza.empty() || data == nullptr)
        return settings.sponza;
    const std::filesystem::path file = std::filesystem::path(data) / "crytek_sponza/sponza.glb";
    return std::filesystem::exists(file) ? file.string() : "";
}

/// The Cornell box has 1102 triangles in the paper, here 1152.
std::vector<Example> examples(const DirectionsSettings& settings)
{
    const std::string box = "scenes/cornell-box.gltf";
    std::vector<Example> all = {
        {"cubes", "four cubes", "scenes/four-cubes.gltf", 5120, Light::sky},
        {"balls", "three balls", "scenes/three-balls.gltf", 5120, Light::sky},
        {"sky", "Cornell box under a sky", box, 4068, Light::sky, 6},
        {"lamp", "Cornell box with its lamp", box, 42624, Light::own, 6},
        {"landscape", "landscape", "", 3764, Light::sky}};
    if (const std::string file = sponza_file(settings); !file.empty())
        all.push_back({"sponza", "Sponza", file, 5604, Light::sky, 1, 5, 2});
    return all;
}

Scene scene_of(const Example& example, const std::string& sky_file)
{
    Scene scene = example.path.empty() ? landscape(kLandscapeCells) : read_gltf(example.path);
    if (example.pieces > 1)
        scene = cut(std::move(scene), example.pieces);
    if (example.light == Light::sky) {
        for (Material& material : scene.materials)
            material.emitted = glm::vec3(0.0f);
        if (sky_file.empty())
            scene.sky = clear_sky(kSun);
        else
            add_lights(scene, {.sky_file = sky_file});
    }
    return scene;
}

/// What came of the directions.
struct Gathered {
    Image map;  ///< irradiance [lx]
    std::uint64_t directions = 0;
    gpu::StageTimes stages;  ///< [ms]
    Stopwatch watch;
};

Gathered gather(const gpu::Device& device, const SolveScene& world, const SolverOptions& options)
{
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const NearField none = no_near_field(world.lumels);
    const auto solver = make_solver({&device, &resident, world.lumels, none}, options);
    Gathered gathered;
    gathered.watch.start();
    solve(*solver, options);
    const std::vector<glm::vec3> irradiance = solver->irradiance();
    gathered.watch.stop();
    gathered.map = finish_map(world.scene, world.atlas, world.lumels, irradiance);
    gathered.directions = solver->state().shots;
    gathered.stages = solver->times();
    return gathered;
}

SolverOptions options_for(const DirectionsSettings& settings, const Example& example)
{
    auto directions = options_of<DirectionsOptions>(settings.shared);
    directions.layers = Layers::stochastic;
    directions.lookup_test = LookupTest::paper;
    directions.lookups = example.lookups > 0 ? example.lookups : directions.lookups;
    SolverOptions options = papers_iteration(directions);
    options.max_shots =
        std::uint64_t(settings.directions > 0 ? settings.directions : example.directions);
    options.target_error = 0.0;
    return options;
}

/// The paper's rule, ours and exact layers, along the same directions.
struct Compared {
    Gathered paper, planes, list;
};

Compared compare(const gpu::Device& device, const SolveScene& world, SolverOptions options)
{
    auto& directions = std::get<DirectionsOptions>(options.method);
    Compared compared{.paper = gather(device, world, options)};
    directions.lookup_test = LookupTest::planes;
    compared.planes = gather(device, world, options);
    directions.layers = Layers::list;
    compared.list = gather(device, world, options);
    return compared;
}

Image picture_of(const gpu::Device& device, const SolveScene& world, const Image& map, int width)
{
    View view = choose_view(world.scene, world.rays);
    view.aspect = kAspect;
    const Image picture = render_preview(device, world.scene, world.atlas, map, view, width);
    return tone_map(picture);
}

void add_row(Report& report, const Example& example, const SolveScene& world,
             const Compared& compared, const Cell& ours)
{
    const auto directions = double(compared.paper.directions);
    const auto each = [&](double seconds) { return fixed(1e3 * seconds / directions, 2); };
    const auto ms = [&](const char* stage) {
        return fixed(sum_of(compared.paper.stages, {stage}) / directions, 2);
    };
    std::vector<Cell> cells{example.name,
                            find_occluders(world.scene).indices.size() / 3,
                            world.lumels.lumels.size(),
                            compared.paper.directions,
                            each(compared.paper.watch.wall),
                            each(compared.paper.watch.cpu),
                            ms("look along"),
                            ms("gather")};
    for (const Gathered* gathered : {&compared.paper, &compared.planes}) {
        const MapError error = compare_maps(gathered->map, compared.list.map);
        cells.push_back(fixed(100.0 * error.relative_rmse, 1));
        cells.push_back(signed_fixed(100.0 * error.bias, 1));
    }
    cells.push_back(each(compared.list.watch.wall));
    cells.push_back(each(compared.list.watch.cpu));
    report.row(cells, ours);
}

bool is_wanted(const DirectionsSettings& settings, const Example& example)
{
    return settings.scenes.empty() ||
           std::count(settings.scenes.begin(), settings.scenes.end(), example.key) > 0;
}

/// Returns the picture, if one is to be made.
std::vector<Image> show(const DirectionsSettings& settings, const gpu::Device& device,
                        const Example& example, Report& report)
{
    const SolveScene world(scene_of(example, settings.sky),
                           AtlasOptions{.size = settings.shared.size * example.finer});
    const Compared compared = compare(device, world, options_for(settings, example));
    const Solved ours = solve_by_default(device, world);
    const MapError error = compare_maps(map_of(world, ours), compared.list.map);
    add_row(report, example, world, compared, words_of(error.relative_rmse, ours.cpu));
    if (settings.folder.empty())
        return {};
    return {picture_of(device, world, compared.paper.map, settings.width)};
}

}  // namespace

void show_directions(const DirectionsSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const auto options = options_of<DirectionsOptions>(settings.shared);
    report.say(fmt::format("lightmaps of {}², illumination maps of {}², {} × {} lookups, {}",
                           settings.shared.size, options.map_side, options.lookups, options.lookups,
                           words_of(device)));
    report.table("directions",
                 "Scenes lit by global directions ([TN11] figure 9); draw and gather: device, ms a "
                 "direction",
                 {"scene", "triangles", "lumels", "directions", "wall ms per direction", "cpu ms",
                  "draw", "gather", "RMSE against list, %", "bias, %", "by planes, RMSE, %",
                  "by planes, bias, %", "list, wall ms", "list, cpu ms"},
                 none());
    std::vector<std::vector<Image>> rows(1);
    for (const Example& example : examples(settings)) {
        if (!is_wanted(settings, example))
            continue;
        if (rows.back().size() == kPicturesInRow)
            rows.emplace_back();
        for (Image& picture : show(settings, device, example, report))
            rows.back().push_back(std::move(picture));
    }
    if (!settings.folder.empty()) {
        std::filesystem::create_directories(settings.folder);
        const std::string sheet = settings.folder + "/directions.png";
        write_png(sheet, contact_sheet(rows));
        report.picture(sheet, "The scenes of the table, row by row");
    }
    device.check_validation();
}

}  // namespace lumel::bench
