#include "results/files/scene_document.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "results/files/root_node.h"

namespace lumel {
namespace {

constexpr std::size_t kAlignment = 4;         // of accessors [bytes]
constexpr double kInnerOfOuter = 1.0 - 1e-6;  // largest inner cone of a spot

/// A name without bytes that are not UTF-8, which JSON cannot have.
Json valid(const std::string& name)
{
    return Json::parse(Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Builds the document, with all data in one buffer.
class DocumentWriter {
public:
    explicit DocumentWriter(const Scene& scene) : scene_(scene)
    {
        json_["asset"] = {{"version", "2.0"}, {"generator", "lumel"}};
        json_["scene"] = 0;
        json_["scenes"] = {{{"nodes", Json::array()}}};
        json_["nodes"] = Json::array();
    }

    GltfDocument written()
    {
        add_textures();
        for (const Material& material : scene_.materials)
            json_["materials"].push_back(material_of(material));
        add_meshes();
        for (const Instance& instance : scene_.instances)
            add_node(node_of(instance), instance.transform);
        for (const PunctualLight& light : scene_.lights)
            add_light(light);
        add_extensions();
        json_["buffers"] = {{{"byteLength", bytes_.size()}}};
        return {.path = scene_.path, .json = std::move(json_), .buffers = {std::move(bytes_)}};
    }

private:
    std::size_t add_view(std::span<const std::uint8_t> data)
    {
        bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment);
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", data.size()}});
        bytes_.insert(bytes_.end(), data.begin(), data.end());
        return json_["bufferViews"].size() - 1;
    }

    template <class T>
    std::size_t add_accessor(const std::vector<T>& values, ComponentType component,
                             const char* type)
    {
        const std::span<const std::uint8_t> data(
            reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T));
        json_["accessors"].push_back({{"bufferView", add_view(data)},
                                      {"componentType", int(component)},
                                      {"count", values.size()},
                                      {"type", type}});
        return json_["accessors"].size() - 1;
    }

    template <class T>
    void add_attribute(Json& primitive, const char* semantic, const std::vector<T>& values,
                       const char* type)
    {
        if (!values.empty())
            primitive["attributes"][semantic] = add_accessor(values, ComponentType::f32, type);
    }

    void add_textures()
    {
        for (const Texture& texture : scene_.textures) {
            const std::vector<unsigned char> png =
                encode_png(texture.rgba, texture.width, texture.height);
            json_["images"].push_back({{"bufferView", add_view(png)}, {"mimeType", "image/png"}});
            json_["textures"].push_back({{"source", json_["images"].size() - 1}});
        }
    }

    static void add_texture_use(Json& to, const char* name, const TextureUse& use)
    {
        if (use.texture >= 0)
            to[name] = {{"index", use.texture}};
    }

    static Json material_of(const Material& from)
    {
        Json material = {{"name", valid(from.name)}, {"doubleSided", from.double_sided}};
        Json& surface = material["pbrMetallicRoughness"] = {
            {"baseColorFactor",
             {from.base_color.r, from.base_color.g, from.base_color.b, from.base_color.a}},
            {"metallicFactor", from.metallic},
            {"roughnessFactor", from.roughness}};
        add_texture_use(surface, "baseColorTexture", from.base_color_texture);
        add_texture_use(surface, "metallicRoughnessTexture", from.metallic_roughness_texture);
        const float emitted = std::max({from.emitted.r, from.emitted.g, from.emitted.b});
        if (emitted > 0.0f) {
            material["emissiveFactor"] = json_array(from.emitted / emitted);
            material["extensions"]["KHR_materials_emissive_strength"] = {
                {"emissiveStrength", emitted}};
            add_texture_use(material, "emissiveTexture", from.emissive_texture);
        }
        if (from.transmission > 0.0f)
            material["extensions"]["KHR_materials_transmission"] = {
                {"transmissionFactor", from.transmission}};
        if (from.alpha_mode == AlphaMode::blend)
            material["alphaMode"] = "BLEND";
        if (from.alpha_mode == AlphaMode::mask) {
            material["alphaMode"] = "MASK";
            material["alphaCutoff"] = from.alpha_cutoff;
        }
        return material;
    }

    Json primitive_of(const Primitive& from)
    {
        Json primitive = {{"material", from.material}};
        glm::vec3 low = from.positions.front(), high = low;
        for (const glm::vec3& position : from.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        add_attribute(primitive, "POSITION", from.positions, "VEC3");
        json_["accessors"].back().update({{"min", json_array(low)}, {"max", json_array(high)}});
        add_attribute(primitive, "NORMAL", from.normals, "VEC3");
        add_attribute(primitive, "TEXCOORD_0", from.texcoords[0], "VEC2");
        add_attribute(primitive, "COLOR_0", from.colors, "VEC4");
        primitive["indices"] = add_accessor(from.indices, ComponentType::u32, "SCALAR");
        return primitive;
    }

    /// Adds meshes that instances show; glTF allows none without primitives.
    void add_meshes()
    {
        meshes_.resize(scene_.meshes.size(), -1);
        for (const Instance& instance : scene_.instances) {
            const Mesh& from = scene_.meshes[std::size_t(instance.mesh)];
            int& number = meshes_[std::size_t(instance.mesh)];
            if (number >= 0 || from.primitives.empty())
                continue;
            number = int(json_["meshes"].size());
            Json mesh = {{"name", valid(from.name)}};
            for (const Primitive& primitive : from.primitives)
                mesh["primitives"].push_back(primitive_of(primitive));
            json_["meshes"].push_back(std::move(mesh));
        }
    }

    /// transform: in the scene.
    void add_node(Json node, const glm::mat4& transform)
    {
        glm::dmat4 world(transform);
        world[3] += glm::dvec4(scene_.origin, 0.0);
        add_root(json_, std::move(node), world);
    }

    Json node_of(const Instance& instance) const
    {
        Json node = {{"name", valid(instance.name)}};
        if (const int mesh = meshes_[std::size_t(instance.mesh)]; mesh >= 0)
            node["mesh"] = mesh;
        return node;
    }

    void add_light(const PunctualLight& from)
    {
        // Colours of glTF are at most 1.
        const float scale = std::max({from.color.r, from.color.g, from.color.b, 1.0f});
        Json light = {{"name", valid(from.name)},
                      {"color", json_array(from.color / scale)},
                      {"intensity", from.intensity * scale}};
        if (from.range > 0.0f)
            light["range"] = from.range;
        if (from.kind == PunctualLight::Kind::spot) {
            light["type"] = "spot";
            // glTF's are in doubles at most π/2, and the inner one is smaller.
            const double outer = std::min(double(from.outer_cone), 0.5 * std::numbers::pi);
            const double inner = std::min(double(from.inner_cone), outer * kInnerOfOuter);
            light["spot"] = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
        } else {
            light["type"] = from.kind == PunctualLight::Kind::point ? "point" : "directional";
        }
        Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
        Json node = {{"name", valid(from.name)}};
        node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
        if (from.radius > 0.0f)
            node["extras"]["radius"] = from.radius;
        if (from.angle > 0.0f)
            node["extras"]["angle"] = from.angle;
        lights.push_back(std::move(light));
        add_node(std::move(node), from.transform);
    }

    void add_extensions()
    {
        const auto use = [&](const char* name, bool used) {
            if (used)
                json_["extensionsUsed"].push_back(name);
        };
        use("KHR_lights_punctual", !scene_.lights.empty());
        use("KHR_materials_emissive_strength",
            std::ranges::any_of(scene_.materials,
                                [](const Material& m) { return m.emitted != glm::vec3(0.0f); }));
        use("KHR_materials_transmission",
            std::ranges::any_of(scene_.materials,
                                [](const Material& m) { return m.transmission > 0.0f; }));
    }

    const Scene& scene_;
    Json json_;
    Bytes bytes_;
    std::vector<int> meshes_;  ///< numbers of the scene's meshes in the document; -1: left out
};

/// Instances and primitives with their numbers in the document.
Scene renumbered(const Scene& scene)
{
    Scene result;
    result.path = scene.path;
    result.origin = scene.origin;
    result.instances = scene.instances;
    for (std::size_t i = 0; i < result.instances.size(); ++i)
        result.instances[i].node = int(i);
    for (const Mesh& mesh : scene.meshes) {
        Mesh& named = result.meshes.emplace_back();
        named.primitives.resize(mesh.primitives.size());
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
            named.primitives[p].source_primitive = int(p);
    }
    return result;
}

}  // namespace

SceneDocument document_of(const Scene& scene)
{
    return {DocumentWriter(scene).written(), renumbered(scene)};
}

}  // namespace lumel
