#include "rays/paths/surfaces.h"

namespace lumel {

namespace {

/// Interpolates a vertex attribute in a triangle.
template <typename Value>
Value interpolate(const std::vector<Value>& values, const std::uint32_t* corner,
                  const glm::vec2& barycentric)
{
    return values[corner[0]] * (1.0f - barycentric.x - barycentric.y) +
           values[corner[1]] * barycentric.x + values[corner[2]] * barycentric.y;
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : scene_(&scene)
{
    for (const Instance& instance : scene.instances) {
        first_.push_back(surfaces_.size());
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[primitive.material];
            PlacedSurface surface;
            surface.source = &primitive;
            surface.transform = &instance.transform;
            surface.normal_transform = glm::transpose(glm::inverse(glm::mat3(instance.transform)));
            surface.mirrored = glm::determinant(glm::mat3(instance.transform)) < 0.0f;
            surface.double_sided = material.double_sided;
            surface.may_emit = material.emitted != glm::vec3(0.0f);
            surface.uniform = is_uniform(material) && primitive.colors.empty();
            const glm::vec2 nowhere[kTexcoordSets]{};
            if (surface.uniform)
                surface.look = sample_material(scene, primitive.material, nowhere, glm::vec4(1.0f));
            surfaces_.push_back(surface);
        }
    }
}

MaterialSample Surfaces::textured_look(const PlacedSurface& surface, std::uint32_t triangle,
                                       const glm::vec2& barycentric) const
{
    const Primitive& source = *surface.source;
    const std::uint32_t* corner = source.indices.data() + std::size_t(triangle) * 3;
    glm::vec2 texcoord[kTexcoordSets]{};
    for (int set = 0; set < kTexcoordSets; ++set)
        if (!source.texcoords[set].empty())
            texcoord[set] = interpolate(source.texcoords[set], corner, barycentric);
    const glm::vec4 color =
        source.colors.empty() ? glm::vec4(1.0f) : interpolate(source.colors, corner, barycentric);
    return sample_material(*scene_, source.material, texcoord, color);
}

/// Scenes read without gloss reflect diffusely only.
Reflectance Surfaces::reflectance(const MaterialSample& look) const
{
    if (scene_->model == MaterialModel::diffuse)
        return {look.albedo};
    return {look.diffuse, look.specular, shininess_of(look.roughness)};
}

Shading Surfaces::shade(const RayHit& hit) const
{
    const PlacedSurface& surface = surfaces_[index(hit.instance, hit.primitive)];
    Shading shading;
    const float side = hit.front ? 1.0f : -1.0f;
    shading.geometric = side * hit.normal;
    shading.normal = shading.geometric;
    if (!hit.front && !surface.double_sided)
        return shading;

    const MaterialSample look = look_at(surface, hit.triangle, hit.barycentric);
    shading.reflectance = reflectance(look);
    shading.luminance = look.emitted;
    if (surface.source->normals.empty())
        return shading;

    // Uses the interpolated normal unless it points behind the triangle.
    const std::uint32_t* corner = surface.source->indices.data() + std::size_t(hit.triangle) * 3;
    const glm::vec3 bent = side * (surface.normal_transform *
                                   interpolate(surface.source->normals, corner, hit.barycentric));
    if (glm::dot(bent, shading.geometric) > 0.0f)
        shading.normal = glm::normalize(bent);
    return shading;
}

}  // namespace lumel
