#include "scene/scene_hash.h"

#include <cstdio>
#include <cstring>
#include <type_traits>

namespace lumel {

namespace {

/// FNV-1a over 64-bit words. The fold carries high bits down, which whole words need.
class Hash {
public:
    void add_bytes(const void* data, std::size_t size)
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        add_word(size);
        for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes + i, std::min(sizeof word, size - i));
            add_word(word);
        }
    }

    template <typename T>
    void add(const T& value)
    {
        static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, float>);
        add_bytes(&value, sizeof value);
    }

    template <typename T>
    void add(const std::vector<T>& values)
    {
        add_bytes(values.data(), values.size() * sizeof(T));
    }

    template <int N>
    void add(const glm::vec<N, float>& v)
    {
        add_bytes(&v, sizeof v);
    }
    template <int N>
    void add(const glm::mat<N, N, float>& m)
    {
        add_bytes(&m, sizeof m);
    }

    std::string hex() const
    {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
        return text;
    }

private:
    void add_word(std::uint64_t word)
    {
        constexpr std::uint64_t kPrime = 0x100000001b3u;
        state_ = (state_ ^ word) * kPrime;
        state_ ^= state_ >> 32;
    }

    std::uint64_t state_ = 0xcbf29ce484222325u;
};

void add_texture_use(Hash& hash, const TextureUse& use)
{
    hash.add(use.texture);
    hash.add(use.texcoord);
    hash.add(use.transform);
    hash.add(static_cast<int>(use.wrap_s));
    hash.add(static_cast<int>(use.wrap_t));
}

void add_material(Hash& hash, const Material& material)
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

void add_primitive(Hash& hash, const Primitive& primitive)
{
    hash.add(primitive.positions);
    hash.add(primitive.normals);
    hash.add(primitive.texcoords[0]);
    hash.add(primitive.texcoords[1]);
    hash.add(primitive.colors);
    hash.add(primitive.indices);
    hash.add(primitive.material);
}

void add_light(Hash& hash, const PunctualLight& light)
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
    Hash hash;
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
