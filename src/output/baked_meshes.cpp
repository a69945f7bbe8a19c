#include "output/baked_meshes.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "atlas/sides.h"
#include "core/error.h"
#include "gltf/split_sides.h"
#include "output/baked_materials.h"
#include "output/vertex_gather.h"

namespace lumel {
namespace {

using PrimitiveKey = std::pair<std::size_t, std::size_t>;  // mesh, primitive
using NodesOfMesh = std::map<std::size_t, std::vector<std::size_t>>;

[[noreturn]] void fail_changed(const std::string& path)
{
    throw Error(ErrorKind::input, path, "has changed while it was baked; bake it again");
}

const Json* source_primitive(const Json& json, const BakedPrimitive& baked)
{
    const auto nodes = json.find("nodes");
    const auto meshes = json.find("meshes");
    if (nodes == json.end() || meshes == json.end() || baked.node >= nodes->size() ||
        (*nodes)[baked.node].value("mesh", meshes->size()) != baked.mesh ||
        baked.mesh >= meshes->size())
        return nullptr;
    const Json& primitives = (*meshes)[baked.mesh].at("primitives");
    return baked.primitive < primitives.size() ? &primitives[baked.primitive] : nullptr;
}

// Where the old TEXCOORD_1 goes: to number 0 if no texture reads that, as many viewers support only
// two; else to the next free number, as glTF allows no gap.
int new_texcoord(const Json& attributes, const Json& json,
                 const std::vector<std::size_t>& materials)
{
    std::set<int> read;
    for (const std::size_t material : materials)
        read.merge(texcoords_read_by(json.at("materials").at(material)));
    if (!read.contains(1) || !attributes.contains("TEXCOORD_1"))
        return kNotMoved;
    int number = read.contains(0) ? 2 : 0;
    while (number > 0 && attributes.contains("TEXCOORD_" + std::to_string(number)))
        ++number;
    return number;
}

NodesOfMesh nodes_of_meshes(const Json& json)
{
    NodesOfMesh nodes;
    const Json& list = json.at("nodes");
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].contains("mesh"))
            nodes[index_of(list[i].at("mesh"))].push_back(i);
    return nodes;
}

// The file's primitive as a triangle list with its vertices split as in the surface.
Json split_primitive(const Json& original, const BakedPrimitive& baked, const Surface& surface,
                     bool turned, const Atlas& atlas, VertexGather& gather)
{
    const auto gathered = [&](const Json& accessor, const std::string& semantic) {
        return turned ? gather.gather_turned(accessor, surface.source_vertex, semantic)
                      : gather.gather(accessor, surface.source_vertex, semantic);
    };
    Json primitive = original;
    Json attributes = Json::object();
    for (const auto& [name, accessor] : original.at("attributes").items()) {
        std::string kept_as = name;
        if (name == "TEXCOORD_1" && baked.moved_texcoord == kNotMoved)
            continue;
        if (name == "TEXCOORD_0" && baked.moved_texcoord == 0)
            continue;
        if (name == "TEXCOORD_1")
            kept_as = "TEXCOORD_" + std::to_string(baked.moved_texcoord);
        attributes[kept_as] = gathered(accessor, name);
    }
    if (primitive.contains("targets"))
        for (Json& target : primitive["targets"])
            for (auto& [name, accessor] : target.items())
                accessor = gathered(accessor, name);

    // glTF wants a TEXCOORD_0 where there is a TEXCOORD_1; here nothing reads it.
    std::vector<glm::vec2> places;
    const Pages& pages = atlas.pages;
    const glm::vec2 corner(pages.corner(baked.page));
    const glm::vec2 size =
        pages.count > 1 ? glm::vec2(float(pages.side)) : glm::vec2(atlas.width, atlas.height);
    for (const glm::vec2& texcoord : surface.texcoord)
        places.push_back((texcoord - corner) / size);
    const std::size_t place = gather.add_texcoords(places);
    if (!attributes.contains("TEXCOORD_0"))
        attributes["TEXCOORD_0"] = place;
    attributes["TEXCOORD_1"] = place;

    primitive["attributes"] = attributes;
    primitive["indices"] = gather.add_indices(surface.indices, surface.source_vertex.size());
    primitive["material"] = baked.material.value();
    primitive.erase("mode");
    for_variants(primitive, [&](Json& mapping) {
        mapping["material"] = baked.copies.at(index_of(mapping["material"]));
    });
    if (baked.back)
        mark_side(primitive, turned ? MarkedSide::back : MarkedSide::front);
    return primitive;
}

}  // namespace

std::vector<BakedPrimitive> list_baked_primitives(const GltfDocument& document, const Scene& scene,
                                                  const Atlas& atlas)
{
    std::vector<BakedPrimitive> list;
    for (const Surface& surface : atlas.surfaces) {
        const Instance& instance = scene.instances[surface.instance];
        const Primitive& primitive =
            scene.meshes[std::size_t(instance.mesh)].primitives[surface.primitive];
        const Json& nodes = document.json.at("nodes");
        BakedPrimitive baked;
        baked.surface = &surface;
        baked.page = page_of(atlas.pages, surface);
        if (has_own_back(atlas, surface))
            baked.back = back_of(atlas, surface);
        baked.node = std::size_t(instance.node);
        if (baked.node >= nodes.size() || !nodes[baked.node].contains("mesh"))
            fail_changed(document.path);
        baked.mesh = index_of(nodes[baked.node].at("mesh"));
        baked.primitive = std::size_t(primitive.source_primitive);

        const Json* source = source_primitive(document.json, baked);
        if (!source)
            fail_changed(document.path);
        if (source->contains("material"))
            baked.material = index_of(source->at("material"));
        baked.file_materials = materials_of(*source);
        baked.moved_texcoord =
            new_texcoord(source->at("attributes"), document.json, baked.file_materials);
        list.push_back(baked);
    }
    return list;
}

void cut_baked_primitives(Json& json, const std::vector<BakedPrimitive>& baked)
{
    std::map<PrimitiveKey, std::size_t> uses;
    for (const BakedPrimitive& b : baked)
        ++uses[{b.mesh, b.primitive}];
    const NodesOfMesh nodes = nodes_of_meshes(json);
    for (const auto& [key, count] : uses)
        if (count == nodes.at(key.first).size())
            json["meshes"][key.first]["primitives"][key.second] = Json::object();
}

void place_baked_primitives(GlbBuilder& builder, const std::vector<BakedPrimitive>& baked,
                            const Atlas& atlas)
{
    // Fill a copy of the mesh for each node.
    std::map<std::size_t, Json> mesh_of_node;
    VertexGather gather(builder);
    for (const BakedPrimitive& b : baked) {
        const Json& original = builder.document().json.at("meshes")[b.mesh];
        const auto mesh = mesh_of_node.try_emplace(b.node, original).first;
        const Json& source = original["primitives"][b.primitive];
        Json& primitives = mesh->second["primitives"];
        primitives[b.primitive] = split_primitive(source, b, *b.surface, false, atlas, gather);
        if (b.back)
            primitives.push_back(split_primitive(source, b, *b.back, true, atlas, gather));
    }

    // The first copy takes the place of its mesh where nothing else needs that.
    const NodesOfMesh nodes_of_mesh = nodes_of_meshes(builder.json);
    for (const auto& [mesh, nodes] : nodes_of_mesh) {
        bool needed = std::any_of(nodes.begin(), nodes.end(),
                                  [&](std::size_t n) { return !mesh_of_node.contains(n); });
        for (const std::size_t node : nodes) {
            const auto copy = mesh_of_node.find(node);
            if (copy == mesh_of_node.end())
                continue;
            Json& meshes = builder.json["meshes"];
            if (needed) {
                builder.json["nodes"][node]["mesh"] = meshes.size();
                meshes.push_back(std::move(copy->second));
            } else {
                meshes[mesh] = std::move(copy->second);
                needed = true;
            }
        }
    }
}

}  // namespace lumel
