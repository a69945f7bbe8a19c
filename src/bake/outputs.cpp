#include "bake/outputs.h"

#include <numbers>

#include "bake/directional_layers.h"
#include "bake/report.h"
#include "bake/solution_file.h"
#include "finish/finish.h"
#include "images/image_files.h"
#include "images/write_bytes.h"
#include "output/folder.h"
#include "output/gltf_write.h"
#include "preview/preview.h"

namespace lumel {
namespace {

constexpr const char* kLightmap = "lightmap";

/// Reflected plus emitted radiance L = (ρ H + E) / π of every lumel [cd/m²].
std::vector<glm::vec3> radiance_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    std::vector<glm::vec3> radiance;
    radiance.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        radiance.push_back((lumel.albedo * irradiance[i] + lumel.emission) *
                           std::numbers::inv_pi_v<float>);
    }
    return radiance;
}

}  // namespace

void write_map(const OutputFolder& folder, const std::string& name, const Image& map, bool half,
               const Prepared& prepared, std::span<const Layer> directional)
{
    std::map<std::string, std::string> metadata = {
        {"quantity", "irradiance"},         {"unit", "lx"},
        {"colorSpace", "linear Rec. 709"},  {"alpha", "coverage"},
        {"sceneHash", prepared.scene.hash}, {"software", "lumel " LUMEL_VERSION}};
    if (!directional.empty())
        metadata.merge(directional_metadata());
    write_exr(folder.path(name + ".exr"), map, half ? Precision::float16 : Precision::float32,
              metadata, directional);
    write_png(folder.path(name + ".png"), tone_map(map));
}

void write_light(const OutputFolder& folder, const BakeOptions& options, const Prepared& prepared,
                 const gpu::Device* device, const std::vector<glm::vec3>& irradiance,
                 const std::vector<std::vector<glm::vec3>>& coefficients, Stages& stages)
{
    const DirectionalMaps maps = finish_directional(prepared, irradiance, coefficients);
    const Image& map = maps.light;
    const Image radiance = finish_map(prepared.scene, prepared.atlas, prepared.lumels,
                                      radiance_of(prepared.lumels, irradiance));
    write_map(folder, kLightmap, map, options.half, prepared, maps.layers);
    write_solution(folder.path(kSolutionFile), prepared.lumels, irradiance, prepared.open);
    write_scene_glb(folder.path("scene.glb"), prepared.scene, prepared.atlas, map);
    write_baked_glb(folder.path("scene-baked.glb"), prepared.scene, prepared.atlas, radiance);
    if (device && options.preview_width > 0) {
        stages.begin("preview");
        const View view = choose_view(prepared.scene, prepared.rays);
        write_png(folder.path("preview.png"),
                  tone_map(render_preview(*device, prepared.scene, prepared.atlas, map, view,
                                          options.preview_width)));
    }
}

BakeSummary write_bake(OutputFolder& folder, const BakeOptions& options, const Prepared& prepared,
                       const gpu::Device& device, const Solver& solver,
                       const std::vector<glm::vec3>& irradiance, const Results& results,
                       Stages& stages)
{
    write_light(folder, options, prepared, &device, irradiance, results.directional.coefficients,
                stages);
    stages.end();
    device.check_validation();

    const std::string report =
        to_json(bake_report(options, prepared, device, solver, results, stages));
    write_text(folder.path("report.json"), report);
    folder.commit();
    return {results.shots, results.error, stages.seconds(), results.interrupted, report};
}

BakeSummary write_reference(OutputFolder& folder, const BakeOptions& options,
                            const ReferenceOptions& reference, const Prepared& prepared,
                            const std::vector<glm::vec3>& irradiance, bool stopped, Stages& stages)
{
    write_map(folder, kLightmap,
              finish_map(prepared.scene, prepared.atlas, prepared.lumels, irradiance), options.half,
              prepared);
    stages.end();
    const std::string report =
        to_json(reference_report(options.lights, reference, prepared, stopped, stages));
    write_text(folder.path("report.json"), report);
    folder.commit();
    return {std::uint64_t(reference.samples_per_lumel), -1.0, stages.seconds(), stopped, report};
}

}  // namespace lumel
