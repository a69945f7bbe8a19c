// [BSS05] figures 1 and 2: pictures after 100 iterations with maps of 128², and their times; the
// paper's scheme beside the default.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/halves.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "jobs/render/render.h"
#include "results/picture/seen.h"
#include "results/preview/preview.h"
#include "results/preview/view.h"

namespace lumel::bench {
namespace {

/// Sample positions per pixel; the shooters of the default are shared out to them.
constexpr std::uint32_t kPictureSets = 4;

/// Sample positions per pixel by which lamps are found.
constexpr std::uint32_t kLampSets = 16;

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

/// Pixels that show a lamp or are beside one: its edge outweighs all that it lights.
std::vector<char> lamp_pixels(const Scene& scene, int size, int width, int height)
{
    const SolveScene world(Scene(scene), AtlasOptions{.size = size});
    const Seen seen = look(choose_view(world.scene, world.rays), width, height, kLampSets,
                           world.rays, world.surfaces, {});
    const std::size_t count = std::size_t(width) * std::size_t(height);
    std::vector<char> lamp(count, 0);
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
        if (!(luminance(seen.points[i].luminance) > 0.0))
            continue;
        const int x = int(i % count) % width, y = int(i % count) / width;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                lamp[std::size_t(v) * std::size_t(width) + std::size_t(u)] = 1;
    }
    return lamp;
}

/// Without these pixels, which count as not covered.
Image without(Image image, const std::vector<char>& pixels)
{
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (pixels[i])
            image.values[std::size_t(image.channels) * i + 3] = 0.0f;
    return image;
}

/// halves: of the truth, empty for itself.
void add_picture(Report& report, const GlossyScene& given, const char* scheme, int iterations,
                 const TimedPicture& picture, const std::vector<Image>& halves, const Cell& ours)
{
    std::optional<MapError> error;
    if (!halves.empty())
        error = error_of(picture.image, halves);
    report.row({given.name, scheme, iterations, picture.shots, fixed(picture.wall, 2),
                fixed(picture.cpu, 2), error ? fixed(100.0 * error->relative_rmse, 1) : none(),
                error ? signed_fixed(100.0 * error->bias, 1) : none()},
               ours);
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
        {"scene", "scheme", "iterations", "shooters", "wall s", "cpu s", "RMSE %", "bias %"},
        none());
    const auto own = options_of<GlossyOptions>(settings.shared);
    std::vector<std::pair<std::string, std::string>> sheets;  // and captions
    for (const GlossyScene& given : kScenes) {
        const Scene scene = read_gltf(given.file, MaterialModel::glossy);
        std::vector<TimedPicture> paths;
        std::vector<Image> halves;
        for (const std::uint32_t half : {0u, 1u}) {
            GlossyOptions seeded = own;
            seeded.seed += half;
            RenderOptions options = picture_options(settings, {.method = seeded});
            options.paths = settings.paths;
            paths.push_back(take(scene, options));
            const Image& image = paths.back().image;
            halves.push_back(without(
                image, lamp_pixels(scene, settings.shared.size, image.width, image.height)));
        }
        const float exposure = choose_exposure(paths[0].image).value_or(1.0f);
        std::vector<Image> row;
        const TimedPicture by_default = take(scene, picture_options(settings, {.method = own}));
        const Cell ours =
            words_of(error_of(by_default.image, halves).relative_rmse, by_default.cpu);
        const auto add = [&](const char* scheme, int iterations, const TimedPicture& picture,
                             const std::vector<Image>& truth) {
            add_picture(report, given, scheme, iterations, picture, truth, ours);
            row.push_back(tone_map(picture.image, exposure));
        };
        add("[BSS05]", settings.iterations,
            take(scene, picture_options(settings, papers_iteration(own))), halves);
        add("default", settings.iterations, by_default, halves);
        add("paths", 0, paths[0], {});
        const std::string sheet = settings.folder + "/" +
                                  std::filesystem::path(given.file).stem().string() + "-times.png";
        write_png(sheet, contact_sheet({row}));
        sheets.emplace_back(sheet,
                            fmt::format("{}: [BSS05] and the default after {} iterations, {} "
                                        "paths a pixel",
                                        given.name, settings.iterations, settings.paths));
    }
    for (const auto& [sheet, caption] : sheets)
        report.picture(sheet, caption);
    device.check_validation();
}

}  // namespace lumel::bench
