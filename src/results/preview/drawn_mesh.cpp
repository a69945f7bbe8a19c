#include "results/preview/drawn_mesh.h"

#include <algorithm>
#include <cmath>

#include "atlas/lumels/sides.h"
#include "results/preview/preview.shared.h"

namespace lumel {
namespace {

glm::vec2 texture_place(const Primitive& primitive, const TextureUse& use, std::uint32_t vertex)
{
    const auto& uv = primitive.texcoords[use.texcoord];
    return uv.empty() ? glm::vec2(0.0f) : glm::vec2(use.transform * glm::vec3(uv[vertex], 1.0f));
}

std::uint32_t back_of_kind(const Atlas& atlas, const Surface& surface, const Material& material)
{
    if (has_own_back(atlas, surface))
        return kBackIsAnother;
    return material.double_sided ? kBackIsAlike : kBackIsBlack;
}

}  // namespace

DrawnMesh::DrawnMesh(const Scene& scene, const Atlas& atlas)
{
    std::map<std::pair<int, std::uint32_t>, std::vector<const Surface*>> surfaces;
    for (const Surface& surface : atlas.surfaces) {
        const Mesh& mesh = scene.meshes[scene.instances[surface.instance].mesh];
        const int material = mesh.primitives[surface.primitive].material;
        const std::uint32_t back =
            back_of_kind(atlas, surface, scene.materials[std::size_t(material)]);
        surfaces[{material, back}].push_back(&surface);
    }
    for (const auto& [key, list] : surfaces) {
        const auto first = std::uint32_t(indices_.size());
        for (const Surface* surface : list) {
            append(scene, atlas, *surface);
            if (has_own_back(atlas, *surface))
                append(scene, atlas, back_of(atlas, *surface));
        }
        ranges_[key] = {first, std::uint32_t(indices_.size()) - first};
    }
    for (const Instance& instance : scene.instances)
        placed_.push_back(instance.transform);
}

void DrawnMesh::append(const Scene& scene, const Atlas& atlas, const Surface& surface)
{
    const Instance& instance = scene.instances[surface.instance];
    const Primitive& primitive = scene.meshes[instance.mesh].primitives[surface.primitive];
    const Material& material = scene.materials[primitive.material];
    const auto base = std::uint32_t(positions_.size());
    const glm::vec2 size(float(atlas.width), float(atlas.height));
    positions_.resize(positions_.size() + surface.source_vertex.size());
    pieces_.push_back({surface.instance, surface.primitive, base, surface.source_vertex});
    place(scene, pieces_.back());
    for (std::size_t v = 0; v < surface.source_vertex.size(); ++v) {
        const std::uint32_t source = surface.source_vertex[v];
        looks_.emplace_back(texture_place(primitive, material.base_color_texture, source),
                            texture_place(primitive, material.emissive_texture, source));
        lightmap_.push_back(surface.texcoord[v] / size);
        colors_.push_back(primitive.colors.empty() ? glm::vec4(1.0f) : primitive.colors[source]);
    }
    const bool mirrored = glm::determinant(glm::mat3(instance.transform)) < 0.0f;
    for (std::size_t k = 0; k + 2 < surface.indices.size(); k += 3)
        for (const std::size_t corner :
             {std::size_t(0), std::size_t(mirrored ? 2 : 1), std::size_t(mirrored ? 1 : 2)})
            indices_.push_back(base + surface.indices[k + corner]);
}

void DrawnMesh::place(const Scene& scene, const Piece& piece)
{
    const Instance& instance = scene.instances[piece.instance];
    const Primitive& primitive = scene.meshes[instance.mesh].primitives[piece.primitive];
    for (std::size_t v = 0; v < piece.source.size(); ++v)
        positions_[piece.first + v] =
            glm::vec3(instance.transform * glm::vec4(primitive.positions[piece.source[v]], 1.0f));
}

std::optional<Stretch> DrawnMesh::place(const Scene& scene)
{
    std::optional<Stretch> changed;
    for (const Piece& piece : pieces_) {
        if (scene.instances[piece.instance].transform == placed_[piece.instance])
            continue;
        place(scene, piece);
        const std::size_t last = piece.first + piece.source.size();
        changed =
            changed ? Stretch{std::min(changed->first, piece.first), std::max(changed->last, last)}
                    : Stretch{piece.first, last};
    }
    for (std::size_t i = 0; i < placed_.size(); ++i)
        placed_[i] = scene.instances[i].transform;
    return changed;
}

float DrawnMesh::farthest_from(const glm::vec3& point) const
{
    constexpr float kMin = 1e-6f;  // [m] for a scene that is a point
    float most = 0.0f;
    for (const glm::vec3& position : positions_)
        most = std::max(most, glm::dot(position - point, position - point));
    return std::max(kMin, std::sqrt(most));
}

}  // namespace lumel
