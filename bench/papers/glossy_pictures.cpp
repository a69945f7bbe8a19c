// [BSS05] figures 1 and 2: pictures after 100 iterations with maps of 128², and their times; the
// paper's scheme beside the default.

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/stopwatch.h"
#include "jobs/render/render.h"
#include "results/preview/preview.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

/// Sample positions per pixel; the shooters of the default are shared out to them.
constexpr std::uint32_t kPictureSets = 4;

struct GlossyScene {
    const char *name, *file;
};

constexpr GlossyScene kScenes[] = {{"glossy Cornell box", "scenes/glossy-cornell-box.gltf"},
                                   {"specular objects", "scenes/specular-objects.gltf"}};

struct TimedPicture {
    Image image;
    double wall = 0.0, cpu = 0.0;  ///< charts and near field included [s]
    std::uint64_t shots = 0;
};

TimedPicture take(const Scene& scene, const RenderOptions& options)
{
    Stopwatch watch;
    watch.start();
    Rendered rendered = render(Scene(scene), options);
    watch.stop();
    return {std::move(rendered.image), watch.wall, watch.cpu, rendered.summary.shots};
}

RenderOptions picture_options(const GlossyPicturesSettings& settings, const SolverOptions& solver)
{
    RenderOptions options{.width = settings.width, .sets = kPictureSets};
    options.bake.atlas.size = settings.shared.size;
    options.bake.device = settings.shared.device;
    options.bake.solver = solver;
    options.bake.solver.target_error = 0.0;
    options.bake.solver.max_shots =
        std::uint64_t(settings.iterations) * std::uint64_t(batch_of(solver.method));
    options.shots = is_papers(solver.method) ? 0 : options.bake.solver.max_shots;
    return options;
}

/// Of lamps, which are far brighter than what they light [cd/m²]; infinity without one.
double lamp_luminance(const Scene& scene)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Material& material : scene.materials)
        if (luminance(material.emitted) > 0.0)
            least = std::min(least, luminance(material.emitted));
    return least;
}

void add_picture(Report& report, const GlossyScene& given, const char* scheme,
                 const GlossyPicturesSettings& settings, const TimedPicture& picture,
                 const Image* truth, double lamp)
{
    constexpr double kBelowLamp = 0.5;  // of the lamp's luminance: pixels that show none of it
    std::optional<MapError> error;
    if (truth)
        error = compare_maps(picture.image, *truth, kBelowLamp * lamp);
    report.row({given.name, scheme, settings.iterations, picture.shots, fixed(picture.wall, 2),
                fixed(picture.cpu, 2), error ? fixed(100.0 * error->relative_rmse, 1) : none(),
                error ? signed_fixed(100.0 * error->bias, 1) : none()});
}

}  // namespace

void take_glossy_pictures(const GlossyPicturesSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    std::filesystem::create_directories(settings.folder);
    report.say(fmt::format("maps of {}², pictures {} pixels wide, {}", settings.shared.size,
                           settings.width, words_of(device)));
    report.table(
        "pictures", "Pictures with their times ([BSS05] figures 1 and 2), against paths",
        {"scene", "scheme", "iterations", "shooters", "wall s", "cpu s", "RMSE %", "bias %"});
    const auto own = options_of<GlossyOptions>(settings.shared);
    for (const GlossyScene& given : kScenes) {
        const Scene scene = read_gltf(given.file, MaterialModel::glossy);
        const double lamp = lamp_luminance(scene);
        RenderOptions paths = picture_options(settings, {.method = own});
        paths.paths = settings.paths;
        const TimedPicture truth = take(scene, paths);
        std::vector<Image> row;
        const float exposure = choose_exposure(truth.image).value_or(1.0f);
        for (const auto& [name, options] : {std::pair{"[BSS05]", papers_iteration(own)},
                                            std::pair{"default", SolverOptions{.method = own}}}) {
            const TimedPicture picture = take(scene, picture_options(settings, options));
            add_picture(report, given, name, settings, picture, &truth.image, lamp);
            row.push_back(tone_map(picture.image, exposure));
        }
        add_picture(report, given, "paths", settings, truth, nullptr, lamp);
        row.push_back(tone_map(truth.image, exposure));
        const std::string sheet = settings.folder + "/" +
                                  std::filesystem::path(given.file).stem().string() + "-times.png";
        write_png(sheet, contact_sheet({row}));
        report.picture(sheet, fmt::format("{}: [BSS05] and the default after {} iterations, {} "
                                          "paths a pixel",
                                          given.name, settings.iterations, settings.paths));
    }
    device.check_validation();
}

}  // namespace lumel::bench
