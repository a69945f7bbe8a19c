#include "viewer/session/save.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/json/json_file.h"
#include "jobs/bake/bake.h"
#include "results/files/folder.h"
#include "results/files/glb_builder.h"
#include "results/files/root_node.h"
#include "scene/load/gltf_nodes.h"

namespace lumel {
namespace {

constexpr const char *kLights = "KHR_lights_punctual",
                     *kStrength = "KHR_materials_emissive_strength",
                     *kCopies = "EXT_mesh_gpu_instancing",
                     *kSpecular = "KHR_materials_pbrSpecularGlossiness";
constexpr double kSamePlace = 1e-6;  ///< tolerance of transform elements, relative to the largest

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(ErrorKind::input, "", what);
}

bool is_same(const glm::dmat4& a, const glm::dmat4& b)
{
    double most = 1.0, apart = 0.0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            most = std::max(most, std::abs(b[c][r]));
            apart = std::max(apart, std::abs(a[c][r] - b[c][r]));
        }
    return apart <= kSamePlace * most;
}

/// Moves a node's mesh to a new node at its current transform; the old node's children stay.
void place_mesh(Json& gltf, std::size_t number, const glm::dmat4& world)
{
    Json& node = gltf["nodes"][number];
    Json placed = Json::object();
    for (const char* member : {"name", "mesh", "weights", "extras"})
        if (const auto found = node.find(member); found != node.end())
            placed[member] = *found;
    node.erase("mesh");
    node.erase("weights");
    add_root(gltf, std::move(placed), world);
}

void place_things(Json& gltf, const GltfDocument& document, const ViewSession& session)
{
    const Scene& scene = session.scene();
    std::vector<char> deleted(scene.instances.size(), 0), moved = deleted;
    const glm::mat4 still(1.0f);
    for (const MovableObject& thing : session.things())
        for (const std::uint32_t instance : thing.instances) {
            deleted[instance] = thing.deleted;
            moved[instance] = thing.deleted || thing.by_hand * thing.animation != still;
        }
    std::vector<glm::dmat4> given(gltf["nodes"].size(), glm::dmat4(1.0));
    for (const PlacedNode& node : place_nodes(document))
        given[node.node] = node.world;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto number = std::size_t(instance.node);
        const glm::dmat4 world =
            glm::translate(glm::dmat4(1.0), scene.origin) * glm::dmat4(instance.transform);
        const Json& node = document.json["nodes"][number];
        const auto extensions = node.find("extensions");
        const bool is_copy = extensions != node.end() && extensions->contains(kCopies);
        if (is_copy && moved[i])
            refuse("\"" + instance.name +
                   "\" is one of many copies of its node: its move cannot be saved");
        if (deleted[i])
            gltf["nodes"][number].erase("mesh");
        else if (!is_copy && !is_same(world, given[number]))
            place_mesh(gltf, number, world);
    }
}

void set_emission(Json& gltf, Json& material, const glm::vec3& emitted)
{
    const float brightest = std::max({emitted.x, emitted.y, emitted.z});
    const float strength = std::max(brightest, 1.0f);  // factors are 1 at most
    material["emissiveFactor"] = json_array(emitted / strength);
    material["extensions"][kStrength] = {{"emissiveStrength", strength}};
    Json& used = gltf["extensionsUsed"];
    if (std::find(used.begin(), used.end(), kStrength) == used.end())
        used.push_back(kStrength);
}

void set_paint(Json& material, const glm::vec4& colour)
{
    const Json factor = Json::array({colour.r, colour.g, colour.b, colour.a});
    const auto extensions = material.find("extensions");
    if (extensions != material.end() && extensions->contains(kSpecular))
        (*extensions)[kSpecular]["diffuseFactor"] = factor;
    else
        material["pbrMetallicRoughness"]["baseColorFactor"] = factor;
}

/// Writes materials that differ from the file, or whose lamp the animation dims.
void set_materials(Json& gltf, const ViewSession& session)
{
    const bool played = !session.animation().materials.empty();
    const std::size_t count = gltf.contains("materials") ? gltf["materials"].size() : 0;
    for (std::size_t m = 0; m < count; ++m) {
        const Material &now = session.scene().materials[m],
                       &given = session.light().scene().materials[m];
        const bool emits = given.emitted != glm::vec3(0.0f);
        if (emits && (played || now.emitted != given.emitted))
            set_emission(gltf, gltf["materials"][m], now.emitted);
        if (now.base_color != given.base_color)
            set_paint(gltf["materials"][m], now.base_color);
    }
}

/// Lights have their own names, or else those of their nodes.
void dim_lights(Json& gltf, const ViewSession& session)
{
    for (const ViewLamp& lamp : session.lamps()) {
        if (!lamp.is_light || lamp.factor == glm::vec3(1.0f))
            continue;
        if (!session.options().lights.profiles.empty())
            refuse("a dimmed light cannot be saved with --ies");
        bool found = false;
        for (const Json& node : gltf["nodes"]) {
            const auto extensions = node.find("extensions");
            if (extensions == node.end() || !extensions->contains(kLights))
                continue;
            const auto number = (*extensions)[kLights]["light"].get<std::size_t>();
            Json& light = gltf["extensions"][kLights]["lights"][number];
            if (light.value("name", node.value("name", "")) != lamp.name)
                continue;
            found = true;
            const float most = std::max({lamp.factor.x, lamp.factor.y, lamp.factor.z});
            const glm::vec3 factor = most > 0.0f ? lamp.factor / most : lamp.factor;
            const PunctualLight& given = session.light().scene().lights[lamp.index];
            light["color"] = json_array(given.color * factor);
            light["intensity"] = given.intensity * most;
        }
        if (!found)
            refuse("\"" + lamp.name +
                   "\" is dimmed, but not a light of the file: it cannot be saved");
    }
}

}  // namespace

void write_scene_as_it_stands(const ViewSession& session, const std::string& path)
{
    const GltfDocument document = load_gltf_document(session.scene().path);
    GlbBuilder builder(document);
    place_things(builder.json, document, session);
    set_materials(builder.json, session);
    dim_lights(builder.json, session);
    builder.json.erase("animations");
    builder.release();
    const std::vector<std::uint8_t> file = builder.finish();
    write_bytes(path, std::as_bytes(std::span(file)));
}

LightOptions lights_as_they_are(const ViewSession& session)
{
    LightOptions lights = session.options().lights;
    const bool ours = lights.sun.has_value();
    if (session.sun() && !ours)
        refuse("the moved sun of the file cannot be saved; use --sun instead");
    if (ours)
        lights.sun = session.sun();
    const glm::vec3& factor = session.sky();
    if (factor.x == factor.y && factor.y == factor.z)
        lights.sky_scale *= factor.x;
    else if (lights.sky_color)
        *lights.sky_color *= factor;
    else
        refuse("a coloured sky cannot be saved, only a dimmed one");
    if (session.sky_angle() == 0.0)
        return lights;
    if (ours && lights.sky_file.empty() && !lights.sky_color && !lights.cie)
        refuse("a clear sky turned away from its sun cannot be saved");
    lights.sky_rotation += session.sky_angle();
    if (ours)
        lights.sun->azimuth += session.sky_angle();  // keeps its direction
    return lights;
}

BakeSummary save_bake(const ViewSession& session, const std::string& folder,
                      const ProgressFunction& progress)
{
    BakeOptions options;
    options.lights = lights_as_they_are(session);
    options.atlas = session.options().atlas;
    options.device = session.options().device;
    options.preview_width = session.options().width;
    OutputFolder aside(folder, "scene");  // removed with its contents
    const std::string scene =
        aside.path(std::filesystem::path(session.scene().path).stem().string() + ".glb");
    write_scene_as_it_stands(session, scene);
    return bake(scene, folder, options, progress);
}

}  // namespace lumel
