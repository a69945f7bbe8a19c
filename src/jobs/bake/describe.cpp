// lumel info: contents of a scene and cost of a bake.

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "atlas/near/buried.h"
#include "atlas/prepare/lit_sides.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/error.h"
#include "base/json/json_file.h"
#include "gpu/device.h"
#include "jobs/bake/advice.h"
#include "jobs/bake/bake.h"
#include "jobs/solve/memory_plan.h"
#include "jobs/solve/sources.h"
#include "raster/world/occluders.h"

namespace lumel {
namespace {

Json json_of(const GraphicsMemory& bytes)
{
    return {{"staging", bytes.staging}, {"world", bytes.world},
            {"rays", bytes.rays},       {"direct_light", bytes.direct_light},
            {"solver", bytes.solver},   {"directional", bytes.directional},
            {"sweeps", bytes.sweeps}};
}

Json json_of(const HostMemory& bytes)
{
    return {{"program", bytes.program}, {"scene", bytes.scene},     {"trees", bytes.trees},
            {"atlas", bytes.atlas},     {"lumels", bytes.lumels},   {"solver", bytes.solver},
            {"links", bytes.links},     {"working", bytes.working}, {"matrices", bytes.matrices}};
}

/// Buried lumels and open area, estimated from a sample of lumels.
struct Open {
    std::size_t buried = 0;
    double area = 0.0;  ///< [m²]
};

/// A scene prepared as for a bake, except that only a random sample of lumels is tested for burial,
/// which takes most of the time in a large atlas.
class SampledScene {
public:
    SampledScene(Scene scene, const AtlasOptions& options)
        : prepared_(
              std::move(scene),
              [&](const Scene& placed, const RayScene& rays, const ProgressCallback& progress) {
                  return make_atlas(placed, options, progress,
                                    sides_by_light(options.sides, rays, options.daylit));
              },
              [&](const Scene& placed, const RayScene& rays, const Atlas& atlas, Lumels& lumels,
                  const ProgressCallback&) { return mark_some(placed, rays, atlas, lumels); })
    {
    }

    const SolveScene& prepared() const { return prepared_; }
    const Open& open() const { return open_; }

private:
    std::vector<float> mark_some(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                                 Lumels& lumels)
    {
        constexpr std::size_t kLooks = std::size_t(1) << 17;  // estimates the fraction to 0.2 %
        constexpr std::uint32_t kMix = 2654435761u;           // Knuth's multiplier
        const std::size_t count = lumels.lumels.size();
        const std::size_t every = (count + kLooks - 1) / kLooks;
        std::vector<char> chosen(count);
        for (std::size_t i = 0; i < count; ++i)
            chosen[i] = ((std::uint32_t(i) * kMix) >> 8) % every == 0;
        const double whole = front_area(lumels);
        std::vector<float> shares = mark_buried(scene, rays, atlas, lumels, chosen);
        open_.area = std::max(whole - double(every) * (whole - front_area(lumels)), 0.0);
        for (const Lumel& lumel : lumels.lumels)
            open_.buried += (lumel.flags & kLumelBuried) ? every : 0;
        return shares;
    }

    static double front_area(const Lumels& lumels)
    {
        double area = 0.0;
        for (const Lumel& lumel : lumels.lumels)
            area += (lumel.flags & kLumelBack) ? 0.0 : double(lumel.area);
        return area;
    }

    Open open_;
    SolveScene prepared_;
};

/// Limits of the default device; empty if there is none.
std::optional<MemoryLimits> usual_limits(const BakeOptions& options)
{
    try {
        const std::vector<gpu::DeviceInfo> infos = gpu::list_devices();
        if (const gpu::DeviceInfo* best = gpu::best_of(infos))
            return memory_limits(options, *best);
    } catch (const Error&) {
        // Device errors are reported by bake and lumel devices.
    }
    return std::nullopt;
}

/// Lamps of the file, without the options' sun.
std::size_t lamp_count(const Scene& scene, const LightOptions& options)
{
    const bool sun_is_up = options.sun && options.sun->elevation > 0.0;
    return scene.lights.size() - (sun_is_up ? 1 : 0);
}

/// Density of each surface: primitives of one object can differ by material.
Json densities(const Scene& scene, const Atlas& atlas)
{
    Json all = Json::array();
    for (const Surface& surface : atlas.surfaces) {
        const Instance& instance = scene.instances[surface.instance];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Primitive& primitive = mesh.primitives[surface.primitive];
        all.push_back({{"object", instance.name},
                       {"mesh", mesh.name},
                       {"material", scene.materials[std::size_t(primitive.material)].name},
                       {"texels_per_metre", surface.texels_per_metre}});
    }
    return all;
}

Json facts(const SampledScene& sampled, const BakeOptions& options)
{
    const SolveScene& prepared = sampled.prepared();
    const Scene& scene = prepared.scene;
    const Occluders occluders = find_occluders(scene, {}, &prepared.atlas);
    std::size_t emissive = 0, authored = 0, back = 0;
    for (const Material& material : scene.materials)
        emissive += material.emitted != glm::vec3(0.0f);
    for (const Surface& surface : prepared.atlas.surfaces)
        authored += surface.authored;
    for (const Lumel& lumel : prepared.lumels.lumels)
        back += (lumel.flags & kLumelBack) != 0;
    Json json;
    json["scene"] = scene.path;
    json["hash"] = scene.hash;
    json["meshes"] = scene.meshes.size();
    json["instances"] = scene.instances.size();
    json["triangles"] = triangle_count(scene);
    json["dropped_triangles"] = scene.dropped_triangles;
    json["materials"] = scene.materials.size();
    json["emissive_materials"] = emissive;
    json["textures"] = scene.textures.size();
    json["punctual_lights"] = lamp_count(scene, options.lights);
    json["sun"] = options.lights.sun.has_value();
    json["photometric_profiles"] = scene.profiles.size();
    const glm::dvec3 sky = sky_irradiance(scene.sky);
    json["sky_irradiance_lx"] = {sky.r, sky.g, sky.b};
    json["cameras"] = scene.cameras.size();
    json["surface_area_m2"] = sampled.open().area;
    json["surfaces"] = prepared.atlas.surfaces.size();
    json["surfaces_with_own_lightmap_uv"] = authored;
    json["charts"] = prepared.atlas.chart_count;
    json["atlas_width"] = prepared.atlas.width;
    json["atlas_height"] = prepared.atlas.height;
    json["texels_per_metre"] = prepared.atlas.texels_per_metre;
    json["densities"] = densities(scene, prepared.atlas);
    json["lumels"] = prepared.lumels.lumels.size();
    json["back_lumels"] = back;
    json["buried_lumels"] = sampled.open().buried;
    json["occluding_triangles"] = occluders.inner_indices().size() / 3;
    const std::optional<MemoryLimits> limits = usual_limits(options);
    const GraphicsMemory memory =
        graphics_memory(prepared, options, limits ? limits->of : gpu::DeviceInfo{});
    json["graphics_memory_bytes"] = memory.most();
    json["graphics_memory_parts"] = json_of(memory);
    const bool shared = limits && limits->shared;
    const HostMemory host = host_memory(prepared, options, shared);
    json["host_memory_bytes"] = host.most() + (shared ? memory.most() : 0);
    json["host_memory_parts"] = json_of(host);
    std::vector<std::string> warnings = scene.warnings;
    if (std::string text =
            limits ? shortage(memory, host, prepared.atlas.pages.side, *limits) : std::string();
        !text.empty())
        warnings.push_back(std::move(text));
    json["warnings"] = warnings;
    std::vector<std::string> notes = prepared.atlas.notes;
    for (std::string& sentence : advice(prepared, options.atlas))
        notes.push_back(std::move(sentence));
    json["notes"] = notes;
    return json;
}

std::string lightmap_uv_text(const Json& json)
{
    const auto all = json["surfaces"].get<std::size_t>();
    const auto own = json["surfaces_with_own_lightmap_uv"].get<std::size_t>();
    if (own == 0)
        return "generated (the file has no usable TEXCOORD_1)";
    return own == all ? "the file's TEXCOORD_1 is used"
                      : fmt::format("the file's TEXCOORD_1 is used on {} of {} surfaces", own, all);
}

/// Empty if all densities are equal.
std::string densities_text(const Json& json)
{
    const double common = json["texels_per_metre"].get<double>();
    std::size_t other = 0;
    double least = common, most = common;
    for (const Json& surface : json["densities"]) {
        const double density = surface["texels_per_metre"].get<double>();
        other += density != common;
        least = std::min(least, density);
        most = std::max(most, density);
    }
    if (other == 0)
        return {};
    return fmt::format("{:.4g} to {:.4g} texels per metre, {} of {} surfaces differ "
                       "(--json lists them)",
                       least, most, other, json["densities"].size());
}

std::string text_of(const Json& json)
{
    const auto count = [&](const char* key) { return json[key].get<std::size_t>(); };
    std::string text = json["scene"].get<std::string>() + "\n";
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<16} {}\n", name, value);
    };
    line("content", fmt::format("{} meshes in {} instances, {} triangles, {:.4g} m²",
                                count("meshes"), count("instances"), count("triangles"),
                                json["surface_area_m2"].get<double>()));
    line("materials", fmt::format("{}, {} of them emissive; {} textures", count("materials"),
                                  count("emissive_materials"), count("textures")));
    line("cameras", fmt::format("{}", count("cameras")));
    line("punctual lights", fmt::format("{}", count("punctual_lights")));
    const auto sky = json["sky_irradiance_lx"].get<std::array<double, 3>>();
    if (sky != std::array<double, 3>{})
        line("sky", fmt::format("{:.4g}, {:.4g}, {:.4g} lx on an open plane that faces up", sky[0],
                                sky[1], sky[2]));
    line("lightmap UVs", lightmap_uv_text(json));
    line("atlas", fmt::format("{} × {} texels, {:.4g} texels per metre, {} charts",
                              count("atlas_width"), count("atlas_height"),
                              json["texels_per_metre"].get<double>(), count("charts")));
    if (const std::string densities = densities_text(json); !densities.empty())
        line("densities", densities);
    line("lumels", fmt::format("{}, {} on back sides, about {} hidden by other geometry",
                               count("lumels"), count("back_lumels"), count("buried_lumels")));
    line("graphics memory",
         fmt::format("about {:.1f} MiB", json["graphics_memory_bytes"].get<double>() / 1048576.0));
    line("host memory",
         fmt::format("about {:.1f} MiB", json["host_memory_bytes"].get<double>() / 1048576.0));
    for (const auto& warning : json["warnings"])
        line("warning", warning.get<std::string>());
    for (const auto& note : json["notes"])
        line("note", note.get<std::string>());
    return text;
}

}  // namespace

std::string describe(const std::string& scene_path, const BakeOptions& options, bool json)
{
    const SampledScene sampled(read_scene(scene_path, MaterialModel::diffuse, options.lights),
                               atlas_that_fits(options));
    const Json all = facts(sampled, options);
    return json ? json_text(all) : text_of(all);
}

}  // namespace lumel
