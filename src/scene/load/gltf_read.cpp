#include <algorithm>
#include <new>

#include "base/core/error.h"
#include "scene/gltf/document.h"
#include "scene/gltf/extras.h"
#include "scene/load/gltf_lights.h"
#include "scene/load/gltf_material.h"
#include "scene/load/gltf_mesh.h"
#include "scene/load/gltf_nodes.h"
#include "scene/load/gltf_sky.h"
#include "scene/values/geometry_checks.h"
#include "scene/values/origin.h"
#include "scene/values/scene.h"
#include "scene/values/scene_hash.h"

namespace lumel {

namespace {

/// Counts for warnings.
struct Notes {
    MeshNotes mesh;
    std::size_t flattened_instances = 0;
    std::size_t skinned_instances = 0;
    std::size_t weighted_instances = 0;
    std::size_t unmapped_primitives = 0;
};

/// "3 meshes", "1 mesh".
std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

float density_of(const JsonView& node, const JsonView& mesh)
{
    const float own = density_in_extras(node);
    return own > 0.0f ? own : density_in_extras(mesh);
}

/// Reads meshes and instances of the default scene; other meshes are skipped.
void read_geometry(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene,
                   Notes& notes)
{
    const JsonView root = document.root();
    const std::size_t mesh_count = root.count("meshes");
    const int default_material = int(root.count("materials"));
    scene.meshes.resize(mesh_count);
    std::vector<std::optional<Bounds>> bounds(mesh_count);
    for (const PlacedNode& placed : nodes) {
        const JsonView node = root.get("nodes").at(placed.node);
        const auto reference = node.find("mesh");
        if (!reference)
            continue;
        const std::size_t index = reference->index(mesh_count, "meshes");
        Mesh& mesh = scene.meshes[index];
        if (!bounds[index]) {
            mesh = read_mesh(document, index, default_material, notes.mesh);
            bounds[index] = bounds_of(mesh);
        }
        if (is_flat(placed.world)) {
            ++notes.flattened_instances;
            continue;
        }
        if (reaches_too_far(*bounds[index], placed.world))
            node.fail(
                "places its mesh more than 1e9 m from the origin, too far out to be computed");
        notes.skinned_instances += node.find("skin").has_value();
        notes.weighted_instances += node.find("weights").has_value();
        if (!mesh.primitives.empty())
            scene.instances.push_back({node.string_or("name", mesh.name), int(index),
                                       int(placed.node), glm::mat4(placed.world),
                                       density_of(node, root.get("meshes").at(index))});
    }
    scene.dropped_triangles = notes.mesh.zero_area_triangles;
}

/// Centres a scene that lies far from 0, before its transforms become floats.
void recentre(Scene& scene, std::vector<PlacedNode>& nodes)
{
    const auto world_of = [&](const Instance& instance) -> const glm::dmat4& {
        const auto found = std::lower_bound(
            nodes.begin(), nodes.end(), std::size_t(instance.node),
            [](const PlacedNode& placed, std::size_t node) { return placed.node < node; });
        return found->world;
    };
    scene.origin = origin_for(scene, world_of);
    if (scene.origin == glm::dvec3(0.0))
        return;
    for (PlacedNode& placed : nodes)
        placed.world[3] -= glm::dvec4(scene.origin, 0.0);
    for (Instance& instance : scene.instances)
        instance.transform = world_of(instance);
}

/// Materials and textures used by the primitives.
MaterialList read_looks(const GltfDocument& document, MaterialModel model, Scene& scene,
                        Notes& notes)
{
    const std::size_t default_material = document.root().count("materials");
    std::vector<bool> used(default_material + 1, false);
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            used[std::size_t(primitive.material)] = true;
    MaterialList list = read_materials(document, used, model);
    scene.materials = list.materials;
    if (used[default_material])
        scene.materials.push_back({.name = "default"});
    scene.textures = read_textures(document, list.images);

    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            const Material& material = scene.materials[std::size_t(primitive.material)];
            for (const TextureUse* use : {&material.base_color_texture, &material.emissive_texture})
                if (use->texture >= 0 && primitive.texcoords[use->texcoord].empty()) {
                    ++notes.unmapped_primitives;
                    break;
                }
        }
    return list;
}

void warn(Scene& scene, std::size_t count, const std::string& one, const std::string& many,
          const std::string& what)
{
    if (count > 0)
        scene.warnings.push_back(counted(count, one, many) + " " + what);
}

void write_warnings(const Notes& notes, const MaterialList& looks, Scene& scene)
{
    const MeshNotes& mesh = notes.mesh;
    warn(scene, mesh.zero_area_triangles, "triangle", "triangles", "of zero area dropped");
    warn(scene, mesh.stray_indices, "index", "indices", "left over after whole triangles, ignored");
    warn(scene, mesh.points_and_lines, "primitive", "primitives", "of points or lines skipped");
    warn(scene, mesh.repaired_normals, "normal", "normals",
         "without a direction replaced by those of the faces");
    warn(scene, mesh.morphed_meshes, "mesh", "meshes",
         "with morph targets baked at the default weights");
    warn(scene, notes.weighted_instances, "node", "nodes",
         "with morph weights of their own baked at those of the mesh");
    warn(scene, notes.skinned_instances, "skinned mesh", "skinned meshes",
         "baked in the pose of the mesh itself, without its skeleton");
    warn(scene, notes.flattened_instances, "node", "nodes", "flattened by a scale of 0, left out");
    warn(scene, notes.unmapped_primitives, "primitive", "primitives",
         "with a texture but without its texture coordinates: the texture's corner is used");
    warn(scene, looks.missing_textures, "texture", "textures", "without an image taken as white");
    warn(scene, looks.transmission_textures, "transmission texture", "transmission textures",
         "taken as white");
    if (looks.clamped)
        scene.warnings.emplace_back("base colours outside 0 to 1 were clamped");
}

Scene read_scene(const GltfDocument& document, MaterialModel model)
{
    Scene scene;
    scene.path = document.path;
    scene.model = model;
    Notes notes;
    std::vector<PlacedNode> nodes = place_nodes(document);
    read_geometry(document, nodes, scene, notes);
    if (scene.instances.empty())
        throw Error(ErrorKind::input, scene.path,
                    "its scene shows no triangles, there is nothing to bake");
    recentre(scene, nodes);
    const MaterialList looks = read_looks(document, model, scene, notes);
    read_lights_and_cameras(document, nodes, scene);
    scene.sky = read_image_based_light(document);
    write_warnings(notes, looks, scene);
    scene.hash = hash_scene(scene);
    return scene;
}

}  // namespace

Scene read_gltf(const std::string& path, MaterialModel model)
{
    try {
        return read_scene(load_gltf_document(path), model);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::input, path, "needs more memory than there is");
    }
}

Scene read_gltf(const GltfDocument& document, MaterialModel model)
{
    try {
        return read_scene(document, model);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::input, document.path, "needs more memory than there is");
    }
}

}  // namespace lumel
