// lumel info: what is in a scene and what a bake would take.

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/prepare.h"
#include "directional/spherical_harmonics.h"
#include "gpu/device.h"
#include "world/occluders.h"
#include "world/world.shared.h"

namespace lumel {
namespace {

using nlohmann::ordered_json;

/// Bytes of graphics memory a stochastic bake holds at its peak, but for the near field, whose
/// size is known only once it is built: about this many pairs a lumel.
constexpr double kNearPairsPerLumel = 60.0;

std::uint64_t view_memory(const SolverOptions& solver)
{
    const ViewOptions views = views_of(solver.method);
    return view_pixels(views.projection, std::uint32_t(views.hemicube)) * sizeof(float) *
           std::uint64_t(views.batch);
}

std::uint64_t near_field_memory(std::uint64_t lumels)
{
    return std::uint64_t(double(lumels) * kNearPairsPerLumel) * 2 * sizeof(float);
}

/// What gather_directional() holds beside the solver: sums of the bands, sources, and views and a
/// near field of its own.
std::uint64_t directional_memory(std::uint64_t lumels, const BakeOptions& options)
{
    if (options.directional == Directional::none)
        return 0;
    const auto coefficients = std::uint64_t(coefficient_count(int(options.directional)));
    return lumels * ((coefficients + 1) * sizeof(glm::vec3) + sizeof(glm::vec4)) +
           near_field_memory(lumels) + view_memory(options.solver);
}

/// What the solver holds, and after it gather_directional().
std::uint64_t solver_memory(std::uint64_t lumels, const BakeOptions& options)
{
    constexpr std::uint64_t vectors_per_lumel = 15;  // Iteration's vec3 arrays
    return lumels *
               (sizeof(glm::vec4) + vectors_per_lumel * sizeof(glm::vec3) + 2 * sizeof(float)) +
           view_memory(options.solver) + near_field_memory(lumels) +
           directional_memory(lumels, options);
}

std::uint64_t world_memory(const Prepared& world, const Occluders& occluders)
{
    return world.lumels.lumels.size() * 2 * sizeof(Lumel) +
           world.lumels.pieces.size() * 2 * sizeof(Piece) +
           occluders.positions.size() * (3 * sizeof(glm::vec3) + sizeof(std::uint32_t)) +
           occluders.indices.size() * sizeof(std::uint32_t);
}

/// Direct light is found before the solver is made.
std::uint64_t graphics_memory(const Prepared& world, const Occluders& occluders,
                              const BakeOptions& options)
{
    const float diagonal = glm::length(world.rays.high() - world.rays.low());
    return world_memory(world, occluders) +
           std::max(direct_light_bytes(world.scene, world.lumels, diagonal),
                    solver_memory(world.lumels.lumels.size(), options));
}

std::size_t triangle_count(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            count += primitive.indices.size() / 3;
    return count;
}

ordered_json facts(const Prepared& world, const BakeOptions& options)
{
    const Scene& scene = world.scene;
    const Occluders occluders = find_occluders(scene);
    std::size_t emissive = 0, authored = 0, buried = 0, back = 0;
    for (const Material& material : scene.materials)
        emissive += material.emitted != glm::vec3(0.0f);
    for (const Surface& surface : world.atlas.surfaces)
        authored += surface.authored;
    double area = 0.0;
    for (const Lumel& lumel : world.lumels.lumels) {
        buried += (lumel.flags & kLumelBuried) != 0;
        back += (lumel.flags & kLumelBack) != 0;
        area += (lumel.flags & kLumelBack) ? 0.0 : double(lumel.area);
    }
    ordered_json json;
    json["scene"] = scene.path;
    json["hash"] = scene.hash;
    json["meshes"] = scene.meshes.size();
    json["instances"] = scene.instances.size();
    json["triangles"] = triangle_count(scene);
    json["dropped_triangles"] = scene.dropped_triangles;
    json["materials"] = scene.materials.size();
    json["emissive_materials"] = emissive;
    json["textures"] = scene.textures.size();
    json["punctual_lights"] = scene.lights.size();
    json["photometric_profiles"] = scene.profiles.size();
    const glm::dvec3 sky = sky_irradiance(scene.sky);
    json["sky_irradiance_lx"] = {sky.r, sky.g, sky.b};
    json["cameras"] = scene.cameras.size();
    json["surface_area_m2"] = area;
    json["surfaces"] = world.atlas.surfaces.size();
    json["surfaces_with_own_lightmap_uv"] = authored;
    json["charts"] = world.atlas.chart_count;
    json["atlas_width"] = world.atlas.width;
    json["atlas_height"] = world.atlas.height;
    json["texels_per_metre"] = world.atlas.texels_per_metre;
    json["lumels"] = world.lumels.lumels.size();
    json["back_lumels"] = back;
    json["buried_lumels"] = buried;
    json["occluding_triangles"] = occluders.inner_indices().size() / 3;
    json["graphics_memory_bytes"] = graphics_memory(world, occluders, options);
    json["warnings"] = scene.warnings;
    json["notes"] = world.atlas.notes;
    return json;
}

std::string lightmap_uv_text(const ordered_json& json)
{
    const auto all = json["surfaces"].get<std::size_t>();
    const auto own = json["surfaces_with_own_lightmap_uv"].get<std::size_t>();
    if (own == 0)
        return "charts are made (the file brings no TEXCOORD_1 that can be used)";
    return own == all ? "the file's TEXCOORD_1 is used"
                      : fmt::format("the file's TEXCOORD_1 is used on {} of {} surfaces", own, all);
}

std::string text_of(const ordered_json& json)
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
    line("lumels", fmt::format("{}, {} of them on back sides, {} buried", count("lumels"),
                               count("back_lumels"), count("buried_lumels")));
    line("graphics memory",
         fmt::format("about {:.1f} MiB", json["graphics_memory_bytes"].get<double>() / 1048576.0));
    for (const auto& warning : json["warnings"])
        line("warning", warning.get<std::string>());
    for (const auto& note : json["notes"])
        line("note", note.get<std::string>());
    return text;
}

}  // namespace

std::string describe(const std::string& scene_path, const BakeOptions& options, bool json)
{
    const Prepared world(read_scene(scene_path, MaterialModel::diffuse, options.lights),
                         options.atlas);
    const ordered_json all = facts(world, options);
    return json ? all.dump(2, ' ', false, ordered_json::error_handler_t::replace) : text_of(all);
}

}  // namespace lumel
