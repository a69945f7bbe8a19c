// Light probes and lit glTF files of a bake.

#include <numbers>

#include "api/bake.h"
#include "api/translate.h"
#include "api/values.h"
#include "api/warnings.h"
#include "atlas/finish/finish.h"
#include "base/core/parallel.h"
#include "base/images/image_files.h"
#include "jobs/bake/lit_scenes.h"
#include "results/files/scene_document.h"
#include "results/measure/light_probe.h"
#include "results/preview/view.h"

namespace lumel::v0 {
namespace {

constexpr std::uint32_t kMostSamples = 1u << 20;  ///< of a probe
constexpr int kLargestTexture = 16384;            ///< side [texels]

[[noreturn]] void refuse_result(const std::string& subject, const std::string& what)
{
    throw lumel::Error(lumel::ErrorKind::input, subject, what);
}

const BakedSolution& solution_of(const Baked& baked)
{
    if (!baked.solution)
        refuse_result("Baked", "has no solution: it was reset, or no bake made it");
    return *baked.solution;
}

Probe probe_of(const ProbeLight& light)
{
    Probe probe{.coefficients = {}, .noise = light.noise, .inside = light.inside};
    if (light.inside)
        return probe;
    for (std::size_t i = 0; i < probe.coefficients.size(); ++i) {
        const glm::vec3& c = light.coefficients[i];
        probe.coefficients[i] = {c.r, c.g, c.b};
    }
    return probe;
}

/// subject: the map, for messages.
Image image_of(const Map& map, const Atlas& atlas, const std::string& subject)
{
    constexpr std::size_t kChannels = 4;
    Image image(atlas.width, atlas.height, int(kChannels));
    if (map.width != image.width || map.height != image.height ||
        map.rgba.size() != image.values.size())
        refuse_result(subject, "must have the size of the bake, " + std::to_string(image.width) +
                                   " x " + std::to_string(image.height) + " texels");
    image.values = map.rgba;
    return image;
}

lumel::LightmapFormat format_of(LightmapFormat format)
{
    switch (format) {
    case LightmapFormat::rgb9e5:
        return lumel::LightmapFormat::rgb9e5;
    case LightmapFormat::png:
        return lumel::LightmapFormat::png;
    case LightmapFormat::none:
        return lumel::LightmapFormat::none;
    default:
        return lumel::LightmapFormat::ktx2;
    }
}

/// Calls write(document, scene) with the scene's file as it was read, or a document that contains
/// the scene.
template <class Write>
void with_document(const BakedSolution& baked, const Write& write)
{
    const lumel::Scene& scene = baked.setting.prepared.scene;
    if (baked.document) {
        write(*baked.document, scene);
    } else {
        const SceneDocument made = document_of(scene);
        write(made.document, made.scene);
    }
}

/// Finished [cd/m²].
Image radiance_map(const BakedSolution& baked)
{
    const SolveScene& prepared = baked.setting.prepared;
    return finish_map(prepared.scene, prepared.atlas, prepared.lumels,
                      radiance_of(prepared.lumels, baked.irradiance));
}

std::optional<AddedCamera> camera_of(const SolveScene& prepared)
{
    return camera_for(prepared, choose_view(prepared.scene, prepared.rays));
}

/// Lamps for a scene.glb. maps: of these lamps.
std::vector<SceneLamp> scene_lamps(const std::vector<LampMap>& lamps,
                                   const std::vector<Image>& maps)
{
    std::vector<SceneLamp> found;
    for (std::size_t k = 0; k < lamps.size(); ++k)
        found.push_back({.name = lamps[k].name,
                         .kind = lamps[k].kind,
                         .members = lamps[k].members,
                         .color = {lamps[k].color[0], lamps[k].color[1], lamps[k].color[2]},
                         .error = lamps[k].error,
                         .map = &maps[k]});
    return found;
}

}  // namespace

std::vector<Probe> probes(const Baked& baked, const std::vector<Vec3>& places,
                          std::uint32_t samples)
{
    return translated([&] {
        const BakedSolution& solution = solution_of(baked);
        if (solution.parts != lumel::Parts::all)
            refuse_result("probes", "hold all light, direct and indirect; bake Parts::all");
        if (samples < 1 || samples > kMostSamples)
            refuse_result("samples", "must lie between 1 and " + std::to_string(kMostSamples));
        const SolveScene& prepared = solution.setting.prepared;
        for (std::size_t i = 0; i < places.size(); ++i)
            if (!is_finite(places[i]))
                refuse_result("places[" + std::to_string(i) + "]", "is not finite");
        const LightProbe probe(prepared.scene, prepared.rays, prepared.atlas, prepared.lumels,
                               solution.irradiance, {.samples = samples, .seed = solution.seed});
        std::vector<Probe> result(places.size());
        parallel_for(places.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const glm::dvec3 place(to_glm(places[i]));
                result[i] = probe_of(
                    probe.read(glm::vec3(place - prepared.scene.origin), std::uint32_t(i)));
            }
        });
        return result;
    });
}

void write_scene(const std::string& path, const Baked& baked, LightmapFormat format)
{
    translated([&] {
        const BakedSolution& solution = solution_of(baked);
        const SolveScene& prepared = solution.setting.prepared;
        const Image map = image_of(baked.map, prepared.atlas, "Baked::map");
        // A white surface of irradiance H sends H / π.
        const float exposure = exposure_of(radiance_map(solution)) * std::numbers::inv_pi_v<float>;
        std::vector<Image> maps;
        for (const LampMap& lamp : baked.lamps)
            maps.push_back(image_of(lamp.map, prepared.atlas, "Baked::lamps"));
        const std::vector<SceneLamp> lamps = scene_lamps(baked.lamps, maps);
        const SceneLighting lights{.keep = solution.parts == lumel::Parts::indirect,
                                   .exposure = exposure,
                                   .format = format_of(format),
                                   .camera = camera_of(prepared),
                                   .lamps = lamps};
        with_document(solution, [&](const GltfDocument& document, const lumel::Scene& scene) {
            write_scene_glb(path, document, scene, prepared.atlas, map, lights);
        });
    });
}

void write_baked_scene(const std::string& path, const Baked& baked, int size)
{
    translated([&] {
        const BakedSolution& solution = solution_of(baked);
        if (size < 1 || size > kLargestTexture)
            refuse_result("size", "must lie between 1 and " + std::to_string(kLargestTexture));
        const SolveScene& prepared = solution.setting.prepared;
        const Image map =
            finish_map(prepared.scene, prepared.atlas, prepared.lumels, solution.irradiance);
        const Image radiance = radiance_map(solution);
        const BakedTexture texture = baked_texture(prepared, map, radiance, size);
        const Image shown = tone_map(texture.radiance, exposure_of(radiance));
        with_document(solution, [&](const GltfDocument& document, const lumel::Scene& scene) {
            write_baked_glb(path, document, scene, prepared.atlas, shown, camera_of(prepared));
        });
        if (texture.density < 1.0)
            told({path + ": its textures are downsampled to " + percent_text(texture.density) +
                  "; give a larger size, or use write_scene()"});
    });
}

}  // namespace lumel::v0
