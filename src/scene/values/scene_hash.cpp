#include "scene/values/scene_hash.h"

#include "base/core/fingerprint.h"

namespace lumel {

namespace {

void add_texture_use(Fingerprint& hash, const TextureUse& use)
{
    hash.add(use.texture);
    hash.add(use.texcoord);
    hash.add(use.transform);
    hash.add(static_cast<int>(use.wrap_s));
    hash.add(static_cast<int>(use.wrap_t));
}

void add_material(Fingerprint& hash, const Material& material)
{
    hash.add(material.base_color);
    add_texture_use(hash, material.base_color_texture);
    hash.add(material.metallic);
    hash.add(material.roughness);
    hash.add(material.dielectric_specular);
    add_texture_use(hash, material.metallic_roughness_texture);
    hash.add(material.emitted);
    add_texture_use(hash, material.emissive_texture);
    hash.add(static_cast<int>(material.alpha_mode));
    hash.add(material.alpha_cutoff);
    hash.add(material.transmission);
    hash.add(static_cast<int>(material.double_sided));
}

void add_primitive(Fingerprint& hash, const Primitive& primitive)
{
    hash.add(primitive.positions);
    hash.add(primitive.normals);
    for (int set = 0; set < kTexcoordSets; ++set)
        if (set < 2 || !primitive.texcoords[set].empty())  // keeps hashes if absent
            hash.add(primitive.texcoords[set]);
    hash.add(primitive.colors);
    hash.add(primitive.indices);
    hash.add(primitive.material);
}

void add_light(Fingerprint& hash, const PunctualLight& light)
{
    hash.add(static_cast<int>(light.kind));
    hash.add(light.color);
    hash.add(light.intensity);
    hash.add(light.range);
    hash.add(light.inner_cone);
    hash.add(light.outer_cone);
    hash.add(light.radius);
    hash.add(light.angle);
    hash.add(light.profile);
    hash.add(light.transform);
}

}  // namespace

std::string hash_scene(const Scene& scene)
{
    Fingerprint hash;
    hash.add(scene.max_albedo);
    for (const Texture& texture : scene.textures) {
        hash.add(texture.width);
        hash.add(texture.height);
        hash.add(texture.rgba);
    }
    for (const Material& material : scene.materials)
        add_material(hash, material);
    for (const Mesh& mesh : scene.meshes) {
        hash.add(mesh.primitives.size());
        for (const Primitive& primitive : mesh.primitives)
            add_primitive(hash, primitive);
    }
    for (const Instance& instance : scene.instances) {
        hash.add(instance.mesh);
        hash.add(instance.transform);
    }
    for (const PunctualLight& light : scene.lights)
        add_light(hash, light);
    for (const Photometry& profile : scene.profiles)
        hash.add(profile.candela);
    hash.add(scene.sky.width);
    hash.add(scene.sky.height);
    hash.add(scene.sky.radiance);
    return hash.hex();
}

}  // namespace lumel
