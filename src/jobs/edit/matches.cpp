#include "jobs/edit/matches.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace lumel {
namespace {

/// Tolerance of positions, relative to an object's distance from the origin or its size: exporters
/// write transforms as products of rounded parts.
constexpr float kSamePlace = 1e-5f;

template <class T>
void append(std::string& bytes, const T& value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends the properties by which the surface blocks light.
void append_opacity(std::string& bytes, const Scene& scene, const Primitive& primitive)
{
    const Material& material = scene.materials[primitive.material];
    append(bytes, material.double_sided);
    if (!may_be_transparent(material, primitive))
        return;
    append(bytes, material.alpha_mode);
    append(bytes, material.alpha_cutoff);
    append(bytes, material.transmission);
    append(bytes, material.base_color);
    if (material.base_color_texture.texture < 0)
        return;
    for (const std::uint8_t value : scene.textures[material.base_color_texture.texture].rgba)
        append(bytes, value);
    for (const std::uint32_t index : primitive.indices)
        if (const auto& texcoords = primitive.texcoords[material.base_color_texture.texcoord];
            !texcoords.empty())
            append(bytes, texcoords[index]);
}

/// Equal for meshes that block light alike, independent of vertex sharing.
std::size_t shape_key(const Scene& scene, const Mesh& mesh)
{
    std::string bytes;
    for (const Primitive& primitive : mesh.primitives) {
        append(bytes, primitive.indices.size());
        for (const std::uint32_t index : primitive.indices) {
            append(bytes, primitive.positions[index]);
            if (!primitive.normals.empty())
                append(bytes, primitive.normals[index]);
        }
        append_opacity(bytes, scene, primitive);
    }
    return std::hash<std::string_view>()(bytes);
}

std::vector<std::size_t> shape_keys(const Scene& scene)
{
    std::vector<std::size_t> of_mesh, keys;
    for (const Mesh& mesh : scene.meshes)
        of_mesh.push_back(shape_key(scene, mesh));
    for (const Instance& instance : scene.instances)
        keys.push_back(of_mesh[std::size_t(instance.mesh)]);
    return keys;
}

bool stands_alike(const Scene& scene, const Instance& instance, const glm::mat4& other)
{
    for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
        for (const glm::vec3& p : primitive.positions) {
            const glm::vec3 a(instance.transform * glm::vec4(p, 1.0f));
            const glm::vec3 b(other * glm::vec4(p, 1.0f));
            const float reach = std::max(glm::length(a), glm::length(p));
            if (!(glm::distance(a, b) <= kSamePlace * reach))
                return false;
        }
    return true;
}

}  // namespace

Matches match_instances(const Scene& before, const Scene& after)
{
    Matches matches;
    matches.before.assign(after.instances.size(), kNoInstance);
    matches.after.assign(before.instances.size(), kNoInstance);
    matches.moved.assign(after.instances.size(), 1);

    std::map<std::size_t, std::vector<std::uint32_t>> candidates;
    const std::vector<std::size_t> keys_before = shape_keys(before), keys = shape_keys(after);
    for (std::uint32_t b = 0; b < keys_before.size(); ++b)
        candidates[keys_before[b]].push_back(b);
    const auto stays = [&](std::uint32_t a, std::uint32_t b) {
        return stands_alike(after, after.instances[a], before.instances[b].transform);
    };
    const auto is_called_alike = [&](std::uint32_t a, std::uint32_t b) {
        return after.instances[a].name == before.instances[b].name;
    };
    const auto pair_where = [&](const auto& fits) {
        for (std::uint32_t a = 0; a < keys.size(); ++a) {
            std::vector<std::uint32_t>& left = candidates[keys[a]];
            if (matches.before[a] != kNoInstance)
                continue;
            const auto found =
                std::find_if(left.begin(), left.end(), [&](std::uint32_t b) { return fits(a, b); });
            if (found == left.end())
                continue;
            matches.before[a] = *found;
            matches.after[*found] = a;
            matches.moved[a] = stays(a, *found) ? 0 : 1;
            left.erase(found);
        }
    };
    pair_where([&](auto a, auto b) { return is_called_alike(a, b) && stays(a, b); });
    pair_where(stays);
    pair_where(is_called_alike);
    pair_where([](auto, auto) { return true; });
    return matches;
}

}  // namespace lumel
