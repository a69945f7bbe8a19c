#include "jobs/render/render.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/log.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/reference.h"
#include "jobs/render/layers.h"
#include "jobs/render/picture_file.h"
#include "jobs/render/picture_report.h"
#include "jobs/solve/dump.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/poses.h"
#include "jobs/solve/setting.h"
#include "methods/glossy/glossy.h"
#include "results/files/folder.h"
#include "results/picture/lobe_rays.h"
#include "results/picture/lumel_sight.h"
#include "results/picture/picture.h"
#include "results/preview/view.h"
#include "results/record/origin.h"
#include "scene/values/animation.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Checks for failures before the long work.
void check(const std::string& path, const RenderOptions& options)
{
    if (!is_exr(path) && !path.ends_with(".png"))
        throw Error(ErrorKind::input, path, "should end in .png or .exr");
    if (options.shots == 0 && options.rays == 0)
        throw Error(ErrorKind::input, "--eye-shots 0 --lobe-rays 0",
                    "would leave out all gloss; one of them must be above 0");
    if (options.shots > 0 && is_papers(options.bake.solver.method))
        throw Error(ErrorKind::input, "--eye-shots",
                    "has no effect with --scheme paper, whose --shots also light the image");
    if (options.film.frames > 0 && (options.paths > 0 || !options.bake.dump.empty()))
        throw Error(ErrorKind::input, "--frames", "cannot be used with --paths or --dump");
    if (options.paths > 0 && !options.bake.dump.empty())
        throw Error(ErrorKind::input, "--dump", "has no effect with --paths");
    if (options.layers)
        check_layers(options);
    const OutputFile can_be_written(path);
}

/// Light of the lobes at the points seen [G] [cd/m²], by shooters. Every set of points receives
/// from some, even if the caller stops.
std::vector<glm::vec3> shoot_for(GlossyIllumination& solver, const Seen& seen,
                                 std::span<const float> brightness, const EyeSampling& sampling,
                                 Stages& stages)
{
    if (sampling.shots == 0)
        return std::vector<glm::vec3>(seen.glossy.size(), glm::vec3(0.0f));
    stages.begin("shooting for the eye");
    solver.look_at(seen.glossy, brightness, sampling);
    const std::uint64_t start = solver.state().shots;
    const std::uint64_t least = sampling.sets() * solver.batch();
    bool go_on = true;
    for (std::uint64_t shot = 0; shot < sampling.shots && (go_on || shot < least);
         shot = solver.state().shots - start) {
        go_on = stages.progress(double(shot) / double(sampling.shots), shot);
        solver.step();
    }
    return solver.eye_radiance();
}

/// Light of the lobes by shooters and rays.
std::vector<glm::vec3> reflect(GlossyIllumination& solver, const Seen& seen, const Setting& setting,
                               const LitScene& lit, const RenderOptions& options, Stages& stages)
{
    // Complete iterations for every set of points.
    const std::uint64_t round = seen.sets * std::uint64_t(solver.batch());
    const std::uint64_t shots =
        seen.glossy.empty() ? 0 : (options.shots + round - 1) / round * round;
    const EyeSampling sampling{seen.first, shots, options.rays};
    const std::vector<float> brightness = solver.brightness();
    std::vector<glm::vec3> reflected = shoot_for(solver, seen, brightness, sampling, stages);

    stages.begin("lobe rays");
    const WorldLumels standing(setting.prepared.scene, setting.prepared.rays,
                               setting.prepared.lumels);
    const PowerDraw senders(standing, setting.prepared.lumels, brightness);
    const LobeRayOptions lobes{.rays = options.rays,
                               .shooters = shots > 0 ? sampling.shooters() : 0.0f,
                               .seed = seed_of(options.bake.solver.method)};
    const std::vector<glm::vec3> along =
        gather_along_lobes(seen.glossy, lit, senders, lobes,
                           [&](double fraction) { return stages.progress(fraction); });
    for (std::size_t g = 0; g < along.size(); ++g)
        reflected[g] += along[g];
    return reflected;
}

/// As published: looks up the texture C, the eye's accumulated image per lumel.
std::vector<glm::vec3> look_up_accumulated(GlossyIllumination& solver, const LumelSight& sight,
                                           const Seen& seen, const SolveScene& prepared)
{
    const SideMaps texture =
        finish_sides(prepared.scene, prepared.atlas, prepared.lumels,
                     by_lumel(sight, solver.eye_radiance(), prepared.lumels.lumels.size()));
    return look_up(seen, prepared, texture.front, texture.back);
}

/// An image and its report.
struct Made {
    Image image;
    Report report;
};

Made path_trace(const Scene& scene, RenderOptions options, Stages& stages)
{
    tell_warnings(scene);
    const RayScene rays(scene);
    const View view = view_for(scene, rays, options);
    Image image = path_traced_picture(scene, rays, view, {options.width, options.height},
                                      options.paths, seed_of(options.bake.solver.method), stages);
    stages.end();
    return {std::move(image), path_traced_report(options, scene, stages)};
}

/// A scene with its light, from which the next frame continues.
struct Lit {
    /// lay_out: makes the atlas, or empty. given: the view, if known.
    Lit(Scene scene, const SolveScene::LayOut& lay_out, const std::optional<View>& given,
        const gpu::Device& device, RenderOptions& options, Stages& stages)
        : setting(lay_out
                      ? std::make_unique<Setting>(std::move(scene), lay_out, &device, options.bake,
                                                  stages)
                      : std::make_unique<Setting>(std::move(scene), &device, options.bake, stages)),
          view(given ? *given : view_for(setting->prepared.scene, setting->prepared.rays, options)),
          lamps(light_of_lamps(&device, *setting, options.bake, stages)),
          // Without rays, shooters do all.
          particles(options.rays > 0 ? setting->carriers() : nullptr),
          lumels(shining(setting->prepared.lumels, lamps.irradiance,
                         particles ? Lobes::carried : Lobes::diffuse)),
          solver(device, *setting->world, lumels ? *lumels : setting->prepared.lumels,
                 setting->near, std::get<GlossyOptions>(options.bake.solver.method),
                 lamps.irradiance, particles)
    {
    }

    std::unique_ptr<Setting> setting;
    View view;
    DirectLight lamps;
    const LobeParticles* particles;
    std::optional<Lumels> lumels;
    GlossyIllumination solver;
};

/// before: the previous frame, solved with the same atlas, or null.
Made shoot(Lit& frame, Lit* before, const gpu::Device& device, const RenderOptions& options,
           Stages& stages)
{
    std::optional<OutputFolder> dump;
    if (!options.bake.dump.empty())
        dump.emplace(options.bake.dump, "dump");
    const Setting& setting = *frame.setting;
    const SolveScene& prepared = setting.prepared;
    GlossyIllumination& solver = frame.solver;
    check_size(device, options);
    const bool papers = is_papers(options.bake.solver.method);
    LumelSight sight;
    if (papers) {
        sight = see_lumels(frame.view, WorldLumels(prepared.scene, prepared.rays, prepared.lumels),
                           prepared.lumels);
        solver.accumulate_at(sight.points);
    }
    if (before)
        solver.go_on_from(before->solver,
                          float(options.film.kept * double(before->solver.averaged())));
    SolveRun run = solve_in_stage(solver, options.bake.solver, stages);
    const SolverState solved = solver.state();

    stages.begin("finishing");
    std::vector<glm::vec3> irradiance = solver.irradiance();
    add_light(irradiance, frame.lamps.irradiance);
    if (dump)
        write_dump(*dump, device, setting, irradiance, options.bake.solver);
    const SideMaps maps = finish_sides(prepared.scene, prepared.atlas, prepared.lumels, irradiance);
    const LitScene lit(prepared, maps.front, maps.back);
    stages.begin("looking");
    const Seen seen = look(frame.view, options.width, options.height, options.sets, prepared.rays,
                           prepared.surfaces, prepared.scene.sky,
                           [&](double fraction) { return stages.progress(fraction); });
    std::vector<Image> images = compose(seen, lit);
    add_reflected(images, seen, 0,
                  papers ? look_up_accumulated(solver, sight, seen, prepared)
                         : reflect(solver, seen, setting, lit, options, stages));
    stages.end();
    device.check_validation();
    const Results results{.shots = solver.state().shots,
                          .iterations = solver.state().iterations,
                          .error = solved.error,
                          .interrupted = stages.stopped(),
                          .near_pairs = setting.near.column.size(),
                          .curve = std::move(run.curve),
                          .lamps = frame.lamps};
    return {std::move(images.front()),
            picture_report(options, prepared, device, solver, results, stages)};
}

Made make(Scene scene, const RenderOptions& options, Stages& stages)
{
    if (options.paths > 0)
        return path_trace(scene, options, stages);
    const gpu::Device device(options.bake.device);
    RenderOptions sized = options;
    Lit frame(std::move(scene), {}, {}, device, sized, stages);
    return shoot(frame, nullptr, device, sized, stages);
}

/// picture.png of frame 0 is picture-0001.png.
std::string numbered(const std::string& path, int frame)
{
    std::filesystem::path name(path);
    name.replace_filename(
        fmt::format("{}-{:04d}{}", name.stem().string(), frame + 1, name.extension().string()));
    return name.string();
}

/// Frames use different random numbers if they keep the previous average, which equal ones would
/// not improve; otherwise equal ones keep their noise in place.
RenderOptions of_frame(RenderOptions options, int frame)
{
    auto& glossy = std::get<GlossyOptions>(options.bake.solver.method);
    if (!options.film.fresh && options.film.kept > 0.0)
        glossy.seed += std::uint32_t(frame);
    return options;
}

/// Renders the frames. The report is that of the last, with the names of all files.
Report film(const Scene& scene, const std::string& path, const RenderOptions& options,
            const ProgressFunction& progress)
{
    const Animation animation = read_animation(scene.path, options.film.animation);
    for (const std::string& warning : animation.warnings)
        log_warning(scene.path + ": " + warning);
    Scene start = scene;
    pose(start, animation, 0.0);
    check_poses(start, animation, options.film.frames, options.film.fps);
    const gpu::Device device(options.bake.device);
    std::unique_ptr<Lit> before;
    std::optional<float> exposure;
    std::optional<Atlas> atlas;
    std::optional<View> chosen;  // one for all frames if the file has no camera
    int height = options.height;
    std::vector<std::string> files;
    Report report;
    for (int f = 0; f < options.film.frames && !report.interrupted; ++f) {
        Stages stages(progress);
        Scene posed = scene;
        pose(posed, animation, double(f) / options.film.fps);
        RenderOptions own = of_frame(options, f);
        own.height = height;
        SolveScene::LayOut same;
        if (atlas)
            same = [&](const Scene&, const RayScene&, const ProgressCallback&) { return *atlas; };
        auto frame = std::make_unique<Lit>(std::move(posed), same, chosen, device, own, stages);
        atlas = frame->setting->prepared.atlas;
        if (scene.cameras.empty())
            chosen = frame->view;
        height = own.height;
        Made made = shoot(*frame, options.film.fresh ? nullptr : before.get(), device, own, stages);
        exposure = write_picture(numbered(path, f), made.image, exposure);
        files.push_back(std::filesystem::path(numbered(path, f)).filename().string());
        report = std::move(made.report);
        before = std::move(frame);
    }
    report.exposure = exposure;
    report.files = std::move(files);
    return report;
}

RenderSummary summary_of(const Report& report)
{
    return {report.picture_width,       report.picture_height, report.shots,
            report.estimated_error,     report.wall_seconds,   report.interrupted,
            json_text(to_json(report)), report.files};
}

}  // namespace

Rendered render(Scene scene, const RenderOptions& options, const ProgressFunction& progress)
{
    Stages stages(progress);
    Made made = make(std::move(scene), options, stages);
    return {std::move(made.image), summary_of(made.report)};
}

RenderSummary render(const std::string& scene_path, const std::string& picture_path,
                     const RenderOptions& options, const ProgressFunction& progress)
{
    check(picture_path, options);
    Stages stages(progress);
    stages.begin("reading");
    Scene scene = read_scene(scene_path, MaterialModel::glossy, options.bake.lights);
    if (options.layers)
        return summary_of(render_layers(std::move(scene), picture_path, options, stages));
    if (options.film.frames > 0)
        return summary_of(film(scene, picture_path, options, progress));
    Made made = make(std::move(scene), options, stages);
    made.report.exposure = write_picture(picture_path, made.image);
    made.report.files = {std::filesystem::path(picture_path).filename().string()};
    return summary_of(made.report);
}

}  // namespace lumel
