// Converts a host's arrays to a checked scene.

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "api/scene.h"
#include "api/values.h"
#include "base/core/error.h"
#include "base/core/frame.h"
#include "scene/values/geometry_checks.h"
#include "scene/values/origin.h"
#include "scene/values/scene_hash.h"

namespace lumel::v0 {
namespace {

[[noreturn]] void refuse(const std::string& place, const std::string& what)
{
    throw lumel::Error(lumel::ErrorKind::input, place, what);
}

void check_index(std::size_t index, std::size_t count, const std::string& place, const char* list)
{
    if (index >= count)
        refuse(place, fmt::format("names {}[{}], but there are only {}", list, index, count));
}

void check_unit(float value, const std::string& place, const char* name)
{
    if (!(value >= 0.0f && value <= 1.0f))
        refuse(place, fmt::format("{} must lie between 0 and 1", name));
}

void check_positive(float value, const std::string& place, const char* name)
{
    if (!std::isfinite(value) || value < 0.0f)
        refuse(place, fmt::format("{} must be a number of 0 or more", name));
}

lumel::Texture texture_of(const Texture& from, const std::string& place)
{
    constexpr int kLargestSide = 1 << 16;
    constexpr std::size_t kChannels = 4;
    if (from.width < 1 || from.height < 1 || from.width > kLargestSide ||
        from.height > kLargestSide)
        refuse(place, fmt::format("its sides must lie between 1 and {}", kLargestSide));
    const std::size_t bytes = std::size_t(from.width) * std::size_t(from.height) * kChannels;
    if (from.rgba.size() != bytes)
        refuse(place, fmt::format("has {} bytes, but its size needs {}", from.rgba.size(), bytes));
    return {.width = from.width, .height = from.height, .rgba = from.rgba};
}

AlphaMode alpha_of(Alpha alpha)
{
    switch (alpha) {
    case Alpha::mask:
        return AlphaMode::mask;
    case Alpha::blend:
        return AlphaMode::blend;
    default:
        return AlphaMode::opaque;
    }
}

TextureUse use_of(int texture, std::size_t textures, const std::string& place)
{
    if (texture != kNone)
        check_index(std::size_t(texture), textures, place, "textures");
    return {.texture = texture};
}

lumel::Material material_of(const Material& from, std::size_t textures, const std::string& place)
{
    for (const float value : from.base_color)
        check_unit(value, place, "base_color");
    for (const float value : from.emitted)
        check_positive(value, place, "emitted");
    check_unit(from.metallic, place, "metallic");
    check_unit(from.roughness, place, "roughness");
    check_unit(from.transmission, place, "transmission");
    check_positive(from.alpha_cutoff, place, "alpha_cutoff");
    lumel::Material material;
    material.name = from.name;
    material.base_color = to_glm(from.base_color);
    material.base_color_texture = use_of(from.base_color_texture, textures, place);
    material.metallic = from.metallic;
    material.roughness = from.roughness;
    material.metallic_roughness_texture = use_of(from.metallic_roughness_texture, textures, place);
    material.emitted = to_glm(from.emitted);
    material.emissive_texture = use_of(from.emitted_texture, textures, place);
    material.alpha_mode = alpha_of(from.alpha);
    material.alpha_cutoff = from.alpha_cutoff;
    material.transmission = from.transmission;
    material.double_sided = from.double_sided;
    return material;
}

/// Throws unless `values` is empty or has one finite value per vertex. Normals are not checked:
/// they are repaired.
template <class T>
void check_attribute(const std::vector<T>& values, std::size_t vertices, const std::string& place,
                     const char* name)
{
    if (!values.empty() && values.size() != vertices)
        refuse(place, fmt::format("has {} {} for {} positions", values.size(), name, vertices));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!is_finite(values[i]))
            refuse(place, fmt::format("{}[{}] is not finite", name, i));
}

void check_indices(const Primitive& from, const std::string& place)
{
    if (from.indices.size() % 3 != 0)
        refuse(place,
               fmt::format("has {} indices, not three for each triangle", from.indices.size()));
    for (std::size_t i = 0; i < from.indices.size(); ++i)
        if (from.indices[i] >= from.positions.size())
            refuse(place, fmt::format("indices[{}] is {}, but there are {} positions", i,
                                      from.indices[i], from.positions.size()));
}

lumel::Primitive primitive_of(const Primitive& from, std::size_t materials,
                              const std::string& place)
{
    const std::size_t vertices = from.positions.size();
    check_attribute(from.positions, vertices, place, "positions");
    check_attribute(from.texcoords, vertices, place, "texcoords");
    check_attribute(from.lightmap, vertices, place, "lightmap coordinates");
    check_attribute(from.colors, vertices, place, "colors");
    for (std::size_t i = 0; i < from.colors.size(); ++i)
        for (const float value : from.colors[i])
            check_unit(value, fmt::format("{}: colors[{}]", place, i), "its values");
    if (!from.normals.empty() && from.normals.size() != vertices)
        refuse(place,
               fmt::format("has {} normals for {} positions", from.normals.size(), vertices));
    check_indices(from, place);
    check_index(from.material, materials, place, "materials");
    lumel::Primitive primitive;
    primitive.positions = to_glm(from.positions);
    primitive.normals = to_glm(from.normals);
    primitive.texcoords[0] = to_glm(from.texcoords);
    primitive.texcoords[1] = to_glm(from.lightmap);
    primitive.colors = to_glm(from.colors);
    primitive.indices = from.indices;
    primitive.material = int(from.material);
    return primitive;
}

/// Omits primitives without triangles.
lumel::Mesh mesh_of(const Mesh& from, std::size_t materials, const std::string& place,
                    lumel::Scene& scene)
{
    lumel::Mesh mesh{.name = from.name};
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
        lumel::Primitive primitive =
            primitive_of(from.primitives[i], materials, fmt::format("{}.primitives[{}]", place, i));
        primitive.source_primitive = int(i);
        scene.dropped_triangles += drop_zero_area(primitive);
        repair_normals(primitive);
        if (!primitive.indices.empty())
            mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
}

lumel::Instance instance_of(const Instance& from, const std::vector<lumel::Mesh>& meshes,
                            const std::string& place)
{
    check_index(from.mesh, meshes.size(), place, "meshes");
    const glm::mat4 transform = to_glm(from.transform);
    if (!is_finite(from.transform))
        refuse(place, "its transform is not finite");
    if (glm::transpose(transform)[3] != glm::vec4(0.0f, 0.0f, 0.0f, 1.0f))
        refuse(place, "its transform is not affine: it goes column by column, so elements 3, 7 and "
                      "11 are 0, and 15 is 1");
    if (is_flat(transform))
        refuse(place, "its transform leaves the mesh no volume");
    if (reaches_too_far(bounds_of(meshes[from.mesh]), transform))
        refuse(place, "is too far out, more than 1e9 m from the origin");
    return {.name = from.name, .mesh = int(from.mesh), .node = from.node, .transform = transform};
}

PunctualLight::Kind kind_of(Light::Kind kind)
{
    switch (kind) {
    case Light::Kind::spot:
        return PunctualLight::Kind::spot;
    case Light::Kind::directional:
        return PunctualLight::Kind::directional;
    default:
        return PunctualLight::Kind::point;
    }
}

/// Light to world; the light points along -z.
glm::mat4 placed(const Light& light, const std::string& place)
{
    const float length = glm::length(to_glm(light.direction));
    if (!(length > 0.0f) || !std::isfinite(length) || !is_finite(light.position))
        refuse(place, "its direction or position is not finite, or the direction has no length");
    glm::mat4 transform(frame_about(to_glm(light.direction) / -length));
    transform[3] = glm::vec4(to_glm(light.position), 1.0f);
    return transform;
}

PunctualLight light_of(const Light& from, const std::string& place)
{
    constexpr float kRightAngle = std::numbers::pi_v<float> / 2.0f;
    for (const float value : from.color)
        check_positive(value, place, "color");
    check_positive(from.intensity, place, "intensity");
    check_positive(from.range, place, "range");
    check_positive(from.radius, place, "radius");
    if (!(from.inner_cone >= 0.0f && from.inner_cone <= from.outer_cone &&
          from.outer_cone <= kRightAngle))
        refuse(place, "needs cone angles with 0 <= inner <= outer <= pi/2");
    if (!(from.angle >= 0.0f && from.angle <= kRightAngle / 2.0f))
        refuse(place, "angle must lie between 0 and pi/4");
    PunctualLight light;
    light.kind = kind_of(from.kind);
    light.name = from.name;
    light.color = to_glm(from.color);
    light.intensity = from.intensity;
    light.range = from.range;
    light.inner_cone = from.inner_cone;
    light.outer_cone = from.outer_cone;
    const bool directional = from.kind == Light::Kind::directional;
    light.radius = directional ? 0.0f : from.radius;
    light.angle = directional ? from.angle : 0.0f;
    light.transform = placed(from, place);
    return light;
}

lumel::Sky sky_of(const Sky& from)
{
    if (from.luminance.empty())
        return {};
    if (from.width < 1 || from.height < 1 ||
        from.luminance.size() != std::size_t(from.width) * std::size_t(from.height))
        refuse("sky", "the number of luminances does not match its size");
    for (const Vec3& texel : from.luminance)
        for (const float value : texel)
            check_positive(value, "sky", "luminance");
    return {.width = from.width, .height = from.height, .radiance = to_glm(from.luminance)};
}

}  // namespace

lumel::Scene scene_of(const SceneContent& content)
{
    const auto place = [](const char* list, std::size_t i) {
        return fmt::format("{}[{}]", list, i);
    };
    lumel::Scene scene;
    scene.path = "scene";
    scene.model = MaterialModel::glossy;
    for (const Texture& texture : content.textures)
        scene.textures.push_back(texture_of(texture, place("textures", scene.textures.size())));
    for (const Material& material : content.materials)
        scene.materials.push_back(material_of(material, scene.textures.size(),
                                              place("materials", scene.materials.size())));
    for (const Mesh& mesh : content.meshes)
        scene.meshes.push_back(
            mesh_of(mesh, scene.materials.size(), place("meshes", scene.meshes.size()), scene));
    for (const Instance& instance : content.instances)
        scene.instances.push_back(
            instance_of(instance, scene.meshes, place("instances", scene.instances.size())));
    for (const Light& light : content.lights)
        scene.lights.push_back(light_of(light, place("lights", scene.lights.size())));
    scene.sky = sky_of(content.sky);
    set_origin(scene, origin_for(scene, [](const lumel::Instance& instance) {
                   return glm::dmat4(instance.transform);
               }));
    if (scene.dropped_triangles > 0)
        scene.warnings.push_back(
            fmt::format("{} triangles of zero area dropped", scene.dropped_triangles));
    scene.hash = hash_scene(scene);
    return scene;
}

}  // namespace lumel::v0
