#include "jobs/bake/outputs.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/error.h"
#include "base/core/log.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/directional_layers.h"
#include "jobs/bake/lit_scenes.h"
#include "jobs/bake/reference.h"
#include "jobs/bake/report.h"
#include "jobs/edit/solution_file.h"
#include "results/files/folder.h"
#include "results/files/gltf_write.h"
#include "results/preview/background.h"
#include "results/preview/preview.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

constexpr float kLargestHalf = 65504.0f;

/// Warns of values that half precision cannot hold.
void warn_of_clipping(const Image& map, const std::string& name, Stages& stages)
{
    std::size_t clipped = 0;
    float most = 0.0f;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const float* texel = map.at(x, y);
            const float brightest = std::max({texel[0], texel[1], texel[2]});
            if (brightest <= kLargestHalf || texel[3] == 0.0f)
                continue;
            ++clipped;
            most = std::max(most, brightest);
        }
    if (clipped > 0)
        stages.warn(fmt::format("{} {} of {}.exr receive more than the {:.0f} lx that half "
                                "precision can hold, up to {:.6g} lx, and are clipped; leave out "
                                "--half",
                                clipped, clipped == 1 ? "lumel" : "lumels", name, kLargestHalf,
                                most));
}

}  // namespace

std::map<std::string, std::string> map_metadata(const Scene& scene)
{
    return {{"quantity", "irradiance"},        {"unit", "lx"},
            {"colorSpace", "linear Rec. 709"}, {"alpha", "coverage"},
            {"sceneHash", scene.hash},         {"software", "lumel " + lumel_version()}};
}

float write_map(const OutputFolder& folder, const std::string& name, const Image& map, bool half,
                const SolveScene& prepared, Stages& stages, float exposure,
                std::span<const Layer> directional)
{
    if (half)
        warn_of_clipping(map, name, stages);
    std::map<std::string, std::string> metadata = map_metadata(prepared.scene);
    if (!directional.empty())
        metadata.merge(directional_metadata());
    if (exposure <= 0.0f)
        exposure = choose_exposure(map).value_or(1.0f);
    const Pages& pages = prepared.atlas.pages;
    for (int page = 0; page < pages.count; ++page) {
        const std::string file = folder.path(page_name(pages, page, name));
        const Image part = cut_page(pages, page, map);
        std::vector<Layer> layers;
        for (const Layer& layer : directional)
            layers.push_back({layer.name, cut_page(pages, page, layer.image)});
        write_exr(file + ".exr", part, half ? Precision::float16 : Precision::float32, metadata,
                  layers);
        write_png(file + ".png", tone_map(part, exposure));
    }
    return exposure;
}

void outdate_other_pages(OutputFolder& folder, const Pages& pages)
{
    const auto outdate = [&](const std::string& name) {
        for (const char* ending : {".exr", ".png"})
            folder.outdate(name + ending);
    };
    if (pages.count > 1)
        outdate(kLightmapName);
    const Pages most{kMaxPages, pages.side};
    for (int page = pages.count > 1 ? pages.count : 0; page < kMaxPages; ++page)
        outdate(page_name(most, page, kLightmapName));
}

namespace {

struct DrawnPreview {
    Image picture;   ///< tone-mapped
    float exposure;  ///< [m²/cd]
};

/// Empty, with a warning, if the preview cannot be rendered.
std::optional<DrawnPreview> draw_preview(const gpu::Device& device, const BakeOptions& options,
                                         const SolveScene& prepared, const Image& map,
                                         const Image& radiance, const View& view)
{
    try {
        Preview preview(device, prepared.scene, prepared.atlas);
        const auto seen =
            choose_exposure(preview.draw(prepared.scene, map, view, options.preview_width));
        const float exposure = options.exposure > 0.0f ? options.exposure
                               : seen                  ? *seen
                                                       : exposure_of(radiance);
        Image picture = preview.tone_mapped(exposure);
        put_sky_behind(picture, prepared.scene.sky, view, exposure);
        return DrawnPreview{std::move(picture), exposure};
    } catch (const Error& error) {
        log_warning(std::string("no ") + kPreview + ": " + error.what());
        return std::nullopt;
    }
}

}  // namespace

WrittenLight write_light(const OutputFolder& folder, const BakeOptions& options,
                         const SolveScene& prepared, const gpu::Device* device,
                         const std::vector<glm::vec3>& irradiance, const std::vector<float>& error,
                         const std::vector<std::vector<glm::vec3>>& coefficients, Stages& stages,
                         std::span<const SceneLamp> lamps)
{
    const DirectionalMaps maps = finish_directional(prepared, irradiance, coefficients);
    const Image& map = maps.light;
    const Image radiance = finish_map(prepared.scene, prepared.atlas, prepared.lumels,
                                      radiance_of(prepared.lumels, irradiance));
    const bool draws = device && options.preview_width > 0;
    if (draws)
        stages.begin("preview");
    const auto view =
        draws ? std::optional(choose_view(prepared.scene, prepared.rays)) : std::nullopt;
    auto drawn =
        draws ? draw_preview(*device, options, prepared, map, radiance, *view) : std::nullopt;
    stages.begin("writing");
    // All images have one exposure; a white surface of irradiance H sends H / π.
    const float exposure_of_radiance = drawn                     ? drawn->exposure
                                       : options.exposure > 0.0f ? options.exposure
                                                                 : exposure_of(radiance);
    const WrittenLight written{.exposure = exposure_of_radiance * std::numbers::inv_pi_v<float>,
                               .view = drawn ? view : std::nullopt};
    if (drawn)
        write_png(folder.path(kPreview), drawn->picture);
    drawn.reset();
    write_map(folder, kLightmapName, map, options.half, prepared, stages, written.exposure,
              maps.layers);
    write_solution(folder.path(kSolutionFile), prepared.lumels, irradiance, prepared.open, error);
    const std::optional<AddedCamera> camera = camera_for(prepared, written.view);
    const GltfDocument document = load_gltf_document(prepared.scene.path);
    // If only indirect light is baked, viewers add direct light of lamps themselves.
    write_scene_glb(folder.path(kSceneFile), document, prepared.scene, prepared.atlas, map,
                    {.keep = options.keep_lights || options.parts == Parts::indirect,
                     .exposure = written.exposure,
                     .format = options.lightmap_format,
                     .compression = options.compression,
                     .camera = camera,
                     .lamps = lamps});
    const BakedTexture baked = baked_texture(prepared, map, radiance, options.baked_size);
    if (baked.density < 1.0)
        stages.tell("textures in scene-baked.glb are downsampled to " +
                    percent_text(baked.density) + "; raise --baked-size, or use scene.glb");
    write_baked_glb(folder.path("scene-baked.glb"), document, prepared.scene, prepared.atlas,
                    tone_map(baked.radiance, exposure_of_radiance), camera);
    return written;
}

BakeSummary write_bake(OutputFolder& folder, const BakeOptions& options, const SolveScene& prepared,
                       const gpu::Device& device, const Solver& solver,
                       const std::vector<glm::vec3>& irradiance, const Results& results,
                       const std::vector<std::string>& more, Stages& stages)
{
    WrittenLamps lamps;
    if (results.per_lamp)
        lamps = write_lamps(folder, options, prepared, irradiance, *results.per_lamp, stages);
    const WrittenLight written =
        write_light(folder, options, prepared, &device, irradiance, solver.error_estimate(),
                    results.directional.coefficients, stages, lamps.in_scene);
    stages.end();
    device.check_validation();

    if (!written.view)
        folder.outdate(kPreview);
    folder.outdate(kPageFile);
    folder.outdate(kProbesFile);
    outdate_other_pages(folder, prepared.atlas.pages);
    BakeRecord record = record_of(options, prepared, results, written);
    record.files.insert(record.files.end(), lamps.files.begin(), lamps.files.end());
    record.files.insert(record.files.end(), more.begin(), more.end());
    Report facts = bake_report(record, prepared, device, solver, results, stages);
    facts.preview = preview_row(written, prepared.scene);
    if (!more.empty())
        facts.settings["daylight"] = std::filesystem::absolute(options.daylight).string();
    const Json report = to_json(facts);
    write_json(folder.path(kReportFile), report);
    return {.shots = results.shots,
            .error = results.error,
            .eye_error = results.eye_error,
            .visible_noise = results.visible_noise,
            .seconds = stages.seconds(),
            .interrupted = results.interrupted,
            .report = json_text(report)};
}

BakeSummary write_reference(OutputFolder& folder, const BakeOptions& options,
                            const ReferenceOptions& reference, const SolveScene& prepared,
                            const std::vector<glm::vec3>& irradiance, bool stopped, Stages& stages)
{
    const float exposure =
        write_map(folder, kLightmapName,
                  finish_map(prepared.scene, prepared.atlas, prepared.lumels, irradiance),
                  options.half, prepared, stages);
    stages.end();
    Report facts = reference_report(options, reference, prepared, stopped, stages);
    facts.exposure = exposure;
    const Json report = to_json(facts);
    write_json(folder.path(kReportFile), report);
    outdate_other_pages(folder, prepared.atlas.pages);
    folder.commit();
    return {.shots = std::uint64_t(reference.samples_per_lumel),
            .seconds = stages.seconds(),
            .interrupted = stopped,
            .report = json_text(report)};
}

}  // namespace lumel
