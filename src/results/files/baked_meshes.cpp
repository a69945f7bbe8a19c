#include "results/files/baked_meshes.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "results/files/baked_materials.h"
#include "results/files/vertex_gather.h"
#include "scene/gltf/page_parts.h"
#include "scene/gltf/split_sides.h"

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

// New number of the old TEXCOORD_1: 0 if no texture uses that, as many viewers support only two;
// else the next free number, as glTF allows no gap.
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

/// Lightmap coordinates, added once per surface for all its parts.
class Places {
public:
    Places(const Atlas& atlas, VertexGather& gather) : atlas_(atlas), gather_(gather) {}

    std::size_t accessor_of(const Surface& surface)
    {
        const auto [place, is_new] = accessors_.try_emplace(&surface);
        if (is_new)
            place->second = gather_.add_texcoords(places_of(surface));
        return place->second;
    }

private:
    std::vector<glm::vec2> places_of(const Surface& surface) const
    {
        const Pages& pages = atlas_.pages;
        const glm::vec2 size =
            pages.count > 1 ? glm::vec2(float(pages.side)) : glm::vec2(atlas_.width, atlas_.height);
        const std::vector<std::uint16_t> page = pages_of_vertices(pages, surface);
        std::vector<glm::vec2> places;
        for (std::size_t v = 0; v < surface.texcoord.size(); ++v)
            places.push_back((surface.texcoord[v] - glm::vec2(pages.corner(page[v]))) / size);
        return places;
    }

    const Atlas& atlas_;
    VertexGather& gather_;
    std::map<const Surface*, std::size_t> accessors_;
};

/// Indices of a primitive's triangles of its surface.
std::vector<std::uint32_t> indices_of(const BakedPrimitive& baked, const Surface& surface)
{
    if (baked.triangles.empty())
        return surface.indices;
    std::vector<std::uint32_t> indices;
    for (const std::size_t triangle : baked.triangles)
        for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
            indices.push_back(surface.indices[corner]);
    return indices;
}

/// The part of each triangle, numbered by page.
std::vector<std::uint32_t> parts_of_triangles(const Pages& pages, const Surface& surface)
{
    std::vector<std::uint32_t> parts(surface.indices.size() / 3);
    std::uint32_t part = 0;
    for (const auto& [page, triangles] : triangles_of_pages(pages, surface)) {
        for (const std::uint32_t triangle : triangles)
            parts[triangle] = part;
        ++part;
    }
    return parts;
}

/// True for an attribute that affects how a material shows, if it has no normal texture.
bool is_visible(const std::string& attribute, const Json& material)
{
    if (attribute.starts_with("TEXCOORD_"))
        return std::ranges::any_of(texcoords_read_by(material), [&](int number) {
            return attribute == "TEXCOORD_" + std::to_string(number);
        });
    if (attribute.starts_with("COLOR_"))  // of black, but for its alpha
        return material.value("alphaMode", "OPAQUE") != "OPAQUE";
    return attribute != "TANGENT";
}

// The file's primitive as a triangle list with vertices split as in the surface. material: its
// material in the output, if only visible attributes are kept.
Json split_primitive(const Json& original, const BakedPrimitive& baked, const Surface& surface,
                     bool turned, const Json* material, Places& lightmap, VertexGather& gather)
{
    const auto gathered = [&](const Json& accessor, const std::string& semantic) {
        return turned ? gather.gather_turned(accessor, surface.source_vertex, semantic)
                      : gather.gather(accessor, surface.source_vertex, semantic);
    };
    Json primitive = original;
    erase_part_marks(primitive);
    Json attributes = Json::object();
    for (const auto& [name, accessor] : original.at("attributes").items()) {
        std::string kept_as = name;
        if (name == "TEXCOORD_1" && baked.moved_texcoord == kNotMoved)
            continue;
        if (name == "TEXCOORD_0" && baked.moved_texcoord == 0)
            continue;
        if (name == "TEXCOORD_1")
            kept_as = "TEXCOORD_" + std::to_string(baked.moved_texcoord);
        if (!material || is_visible(kept_as, *material))
            attributes[kept_as] = gathered(accessor, name);
    }
    if (primitive.contains("targets"))
        for (Json& target : primitive["targets"]) {
            Json kept = Json::object();
            for (const auto& [name, accessor] : target.items())
                if (!material || is_visible(name, *material))
                    kept[name] = gathered(accessor, name);
            target = std::move(kept);
        }

    // glTF requires a TEXCOORD_0 beside a TEXCOORD_1; nothing uses it here.
    const std::size_t place = lightmap.accessor_of(surface);
    if (!attributes.contains("TEXCOORD_0"))
        attributes["TEXCOORD_0"] = place;
    attributes["TEXCOORD_1"] = place;

    primitive["attributes"] = attributes;
    primitive["indices"] =
        gather.add_indices(indices_of(baked, surface), surface.source_vertex.size());
    primitive["material"] = baked.material.value();
    primitive.erase("mode");
    for_variants(primitive, [&](Json& mapping) {
        mapping["material"] = baked.copies.at(index_of(mapping["material"]));
    });
    if (baked.back)
        mark_side(primitive, turned ? MarkedSide::back : MarkedSide::front);
    if (!baked.triangles.empty() && !turned)
        mark_part(primitive, {baked.primitive, baked.page});
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
        if (has_own_back(atlas, surface))
            baked.back = std::make_shared<const Surface>(back_of(atlas, surface));
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
        auto pages = triangles_of_pages(atlas.pages, surface);
        for (auto& [page, triangles] : pages) {
            baked.page = page;
            if (pages.size() > 1)
                baked.triangles = std::move(triangles);
            list.push_back(baked);
            ++baked.part;
        }
    }
    return list;
}

void cut_baked_primitives(Json& json, const std::vector<BakedPrimitive>& baked)
{
    std::map<PrimitiveKey, std::size_t> uses;
    for (const BakedPrimitive& b : baked)
        uses[{b.mesh, b.primitive}] += b.part == 0 ? 1 : 0;
    const NodesOfMesh nodes = nodes_of_meshes(json);
    for (const auto& [key, count] : uses)
        if (count == nodes.at(key.first).size())
            json["meshes"][key.first]["primitives"][key.second] = Json::object();
}

void place_baked_primitives(GlbBuilder& builder, const std::vector<BakedPrimitive>& baked,
                            const Atlas& atlas, Attributes kept)
{
    // Makes a copy of the mesh for each node.
    std::map<std::size_t, Json> mesh_of_node;
    VertexGather gather(builder);
    Places places(atlas, gather);
    for (const BakedPrimitive& b : baked) {
        const Json& original = builder.document().json.at("meshes")[b.mesh];
        const auto mesh = mesh_of_node.try_emplace(b.node, original).first;
        const Json& source = original["primitives"][b.primitive];
        Json& primitives = mesh->second["primitives"];
        const Json* const material =
            kept == Attributes::visible ? &builder.json["materials"][b.material.value()] : nullptr;
        Json front = split_primitive(source, b, *b.surface, false, material, places, gather);
        if (b.part > 0)
            primitives.push_back(std::move(front));
        else
            primitives[b.primitive] = std::move(front);
        if (b.part == 0 && !b.triangles.empty())
            mark_order(primitives[b.primitive], parts_of_triangles(atlas.pages, *b.surface));
        if (b.back)
            primitives.push_back(
                split_primitive(source, b, *b.back, true, material, places, gather));
    }

    // The first copy replaces its mesh if nothing else needs that.
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
