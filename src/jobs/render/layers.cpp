// The bake's method solves for all lamps at once, with the same rays. Then one set of sample
// positions and lobe rays serves all images: every ray adds to each lamp's image what it brings of
// that lamp's light, so the images add up.

#include "jobs/render/layers.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "jobs/bake/lamp_maps.h"
#include "jobs/bake/outputs.h"
#include "jobs/render/picture_file.h"
#include "jobs/render/picture_report.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/memory_plan.h"
#include "links/trace/links.h"
#include "results/picture/lobe_rays.h"
#include "results/picture/page_layers.h"
#include "results/picture/picture.h"

namespace lumel {
namespace {

/// [N] 𝓛(B) [lm/m²], by which points that send light are drawn.
std::vector<float> brightness_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    std::vector<float> brightness;
    brightness.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        brightness.push_back(
            float(luminance(lumels.lumels[i].albedo * irradiance[i] + lumels.lumels[i].emission)));
    return brightness;
}

/// Adds the light along lobes, a set of points at a time, as every point has a value of each lamp.
void add_lobes(std::vector<Image>& images, const Seen& seen, const LitScene& lit,
               const PowerDraw& senders, const RenderOptions& options, Stages& stages)
{
    LobeRayOptions lobes{.rays = options.rays, .seed = seed_of(options.bake.solver.method)};
    for (std::uint32_t set = 0; set < seen.sets; ++set) {
        lobes.first = seen.first[set];
        const auto points =
            std::span(seen.glossy).subspan(lobes.first, seen.first[set + 1] - lobes.first);
        const auto progress = [&](double fraction) {
            return stages.progress((double(set) + fraction) / double(seen.sets));
        };
        add_reflected(images, seen, lobes.first,
                      gather_along_lobes(points, lit, senders, lobes, progress));
    }
}

Image sum_of(const std::vector<Image>& images)
{
    Image sum = images.front();
    for (std::size_t k = 1; k < images.size(); ++k)
        for (std::size_t v = 0; v < sum.values.size(); ++v)
            if (v % 4 != 3)  // all cover the same pixels
                sum.values[v] += images[k].values[v];
    return sum;
}

/// "out/picture-NAME" for "out/picture.png".
std::string beside(const std::string& path, const std::string& name)
{
    const std::filesystem::path picture(path);
    return (picture.parent_path() / (picture.stem().string() + "-" + name)).string();
}

void write_one(const std::string& path, const auto& write, std::vector<std::string>& files)
{
    OutputFile file(path);
    write(file.path());
    file.commit();
    files.push_back(std::filesystem::path(path).filename().string());
}

/// Names of the files.
std::vector<std::string> write_layers(const std::string& path, const Image& all,
                                      const std::vector<Image>& images,
                                      const std::vector<NamedLamp>& lamps)
{
    std::vector<std::string> files{std::filesystem::path(path).filename().string()};
    const float exposure = choose_exposure(unmultiplied(all)).value_or(1.0f);
    const std::vector<std::string> names = lamp_map_names(lamps);
    for (std::size_t k = 0; k < images.size(); ++k) {
        const std::string layer = beside(path, names[k]);
        write_one(
            layer + ".exr", [&](const std::string& at) { write_radiance(at, images[k]); }, files);
        write_one(
            layer + ".png",
            [&](const std::string& at) {
                write_png(at, page_layer(images[k], exposure, std::uint32_t(k)));
            },
            files);
    }
    Image plain(all.width, all.height, 3);
    const auto write_plain = [&](const std::string& at) { write_png(at, plain); };
    write_one(beside(path, "black.png"), write_plain, files);
    std::ranges::fill(plain.values, 1.0f);
    write_one(beside(path, "white.png"), write_plain, files);
    return files;
}

}  // namespace

void check_layers(const RenderOptions& options)
{
    const auto refuse = [](const char* option) {
        throw Error(ErrorKind::input, option, "cannot be used with --layers");
    };
    if (options.film.frames > 0)
        refuse("--frames");
    if (options.paths > 0)
        refuse("--paths");
    if (options.shots > 0)
        refuse("--eye-shots");
    if (!options.bake.dump.empty())
        refuse("--dump");
    if (options.bake.sky_directions != BakeOptions{}.sky_directions)
        refuse("--sky-directions");
}

namespace {

/// Throws Error{input} if the images of lamps take more than half of the memory. host: limit
/// [bytes], 0: unknown.
void check_images(std::size_t lamps, const RenderOptions& options, std::uint64_t host)
{
    constexpr std::uint64_t kPixelBytes = 4 * sizeof(float), kShare = 2;
    const std::uint64_t bytes = std::uint64_t(options.width) * std::uint64_t(options.height) *
                                kPixelBytes * (lamps + 1);  // and their sum
    if (host > 0 && bytes > host / kShare)
        throw Error(ErrorKind::input, "--width " + std::to_string(options.width),
                    fmt::format("needs {} MiB for the images of {} lamps; make it smaller, or join "
                                "lamps by --group",
                                bytes >> 20, lamps));
}

}  // namespace

Report render_layers(Scene scene, const std::string& path, RenderOptions options, Stages& stages)
{
    const gpu::Device device(options.bake.device);
    const MemoryLimits limits = memory_limits(options.bake, &device);
    check_memory(scene, options.bake, limits);
    const Setting setting(std::move(scene), &device, options.bake, stages);
    const SolveScene& prepared = setting.prepared;
    const View view = view_for(prepared.scene, prepared.rays, options);
    check_size(device, options);
    limit_links(options.bake, prepared, limits);
    const std::unique_ptr<Solution> solution = solve_light(&device, setting, options.bake, stages);
    const SolverState solved = solution->solver->state();
    const std::optional<LampLights> lamps = keep_lamps_apart(*solution->solver, stages);
    if (!lamps)
        throw Error(ErrorKind::stopped, path, "was stopped before the light of lamps was known");

    check_images(lamps->lamps.size(), options, limits.host);

    stages.begin("finishing");
    const FinishedMaps maps = lamp_maps(prepared, solution->irradiance, lamps->light);
    const LampTable& table = *dynamic_cast<const LinkRadiosity&>(*solution->solver).lamps();
    const LitScene lit(prepared, maps.layers, table);
    const WorldLumels standing(prepared.scene, prepared.rays, prepared.lumels);
    const PowerDraw senders(standing, prepared.lumels,
                            brightness_of(prepared.lumels, solution->irradiance));
    stages.begin("looking");
    const Seen seen =
        look(view, options.width, options.height, options.sets, prepared.rays, prepared.surfaces,
             prepared.scene.sky, [&](double fraction) { return stages.progress(fraction); });
    std::vector<Image> images = compose(seen, lit);
    stages.begin("lobe rays");
    add_lobes(images, seen, lit, senders, options, stages);
    stages.begin("writing");
    const Image all = sum_of(images);
    const std::optional<float> exposure = write_picture(path, all);
    std::vector<std::string> files = write_layers(path, all, images, lamps->lamps);
    stages.end();
    device.check_validation();
    const Results results{.shots = solved.shots,
                          .iterations = solved.iterations,
                          .error = solved.error,
                          .interrupted = stages.stopped(),
                          .near_pairs = setting.near.column.size(),
                          .curve = std::move(solution->run.curve),
                          .lamps = {}};
    Report report = picture_report(options, prepared, device, *solution->solver, results, stages);
    report.exposure = exposure;
    report.files = std::move(files);
    return report;
}

}  // namespace lumel
