#include "results/files/baked_materials.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "scene/gltf/extras.h"

namespace lumel {
namespace {

constexpr const char* kLightmapExtension = "MOZ_lightmap";
constexpr const char* kOwnExtras = "lumel";
constexpr const char* kTextureTransform = "KHR_texture_transform";
constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

// Calls visit(texture info) for every use of a texture, in core members and in extensions.
template <class Value, class Visit>
void for_texture_uses(Value& material, const Visit& visit)
{
    for_objects(material, [&](auto& object) {
        for (auto& [name, use] : object.items())
            if (name.ends_with("Texture") && use.is_object() && use.contains("index"))
                visit(use);
    });
}

// KHR_texture_transform can override the number.
template <class Value>
auto* texcoord_of(Value& use)
{
    using Found = decltype(&use["texCoord"]);
    if (use.contains("extensions") && use["extensions"].contains(kTextureTransform) &&
        use["extensions"][kTextureTransform].contains("texCoord"))
        return Found(&use["extensions"][kTextureTransform]["texCoord"]);
    return use.contains("texCoord") ? Found(&use["texCoord"]) : Found(nullptr);
}

void renumber_texcoord_1(Json& material, int number)
{
    for_texture_uses(material, [&](Json& use) {
        if (Json* texcoord = texcoord_of(use); texcoord && *texcoord == 1)
            *texcoord = number;
    });
}

/// Removes the data of tell_of_lightmap; keeps other extras.
void drop_told(Json& extras)
{
    const auto own = extras.find(kOwnExtras);
    if (own == extras.end() || !own->is_object())
        return;
    own->erase("lightmap");
    own->erase("texCoord");
    own->erase("page");
    if (own->empty())
        extras.erase(kOwnExtras);
}

void drop_lightmap(Json& material)
{
    if (material.contains("extensions"))
        material["extensions"].erase(kLightmapExtension);
    if (material.contains("extras") && material["extras"].is_object())
        drop_told(material["extras"]);
}

std::set<std::size_t> materials_in_use(const Json& json)
{
    std::set<std::size_t> used;
    for (const Json& mesh : json.at("meshes"))
        for (const Json& primitive : mesh.at("primitives"))
            for (const std::size_t material : materials_of(primitive))
                used.insert(material);
    return used;
}

std::set<std::size_t> lightmap_textures(const Json& json)
{
    std::set<std::size_t> textures;
    for_objects(json, [&](const Json& object) {
        if (const auto found = object.find(kLightmapExtension);
            found != object.end() && found->is_object() && found->contains("index"))
            textures.insert(index_of((*found)["index"]));
    });
    return textures;
}

// Moves used elements to the front, and returns the new index of each.
class Compactor {
public:
    explicit Compactor(Json& array) : array_(array) {}

    std::size_t keep(std::size_t index)
    {
        const auto [place, is_new] = places_.try_emplace(index, kept_.size());
        if (is_new)
            kept_.push_back(array_.at(index));
        return place->second;
    }
    void finish() { array_ = kept_; }
    Json& kept() { return kept_; }

private:
    Json& array_;
    Json kept_ = Json::array();
    std::map<std::size_t, std::size_t> places_;
};

void drop_unused_textures(Json& json)
{
    if (!json.contains("textures"))
        return;
    Compactor textures(json["textures"]);
    for_texture_uses(json["materials"],
                     [&](Json& use) { use["index"] = textures.keep(index_of(use["index"])); });
    if (json.contains("images")) {
        Compactor images(json["images"]);
        for_objects(textures.kept(), [&](Json& object) {
            if (object.contains("source"))
                object["source"] = images.keep(index_of(object["source"]));
        });
        images.finish();
    }
    textures.finish();
    for (const char* key : {"textures", "images"})
        if (json.contains(key) && json[key].empty())
            json.erase(key);
}

// Black, and a perfect but rough metal: F0 is the base colour, so it reflects nothing.
Json black_material(const Json& material)
{
    Json black = Json::object();
    for (const char* key : {"name", "alphaMode", "alphaCutoff", "doubleSided", "extras"})
        if (material.contains(key))
            black[key] = material[key];

    const Json none = Json::object();
    Json base = material.value("pbrMetallicRoughness", none);
    const char* factor = "baseColorFactor";
    const char* texture = "baseColorTexture";
    const Json extensions = material.value("extensions", none);
    if (extensions.contains(kSpecularGlossiness)) {
        base = extensions[kSpecularGlossiness];
        factor = "diffuseFactor";
        texture = "diffuseTexture";
    }
    const double alpha = base.contains(factor) ? base[factor].at(3).get<double>() : 1.0;
    black["pbrMetallicRoughness"] = {{"baseColorFactor", {0.0, 0.0, 0.0, alpha}},
                                     {"metallicFactor", 1.0},
                                     {"roughnessFactor", 1.0}};
    const bool is_opaque = material.value("alphaMode", std::string("OPAQUE")) == "OPAQUE";
    if (!is_opaque && base.contains(texture))
        black["pbrMetallicRoughness"]["baseColorTexture"] = base[texture];
    black["emissiveFactor"] = {1.0, 1.0, 1.0};
    return black;
}

void erase_extensions(Json& part, bool is_texture)
{
    for_objects(part, [&](Json& object) {
        if (!object.contains("extensions"))
            return;
        // A texture without a core image has only its extension.
        if (is_texture && !object.contains("source"))
            return;
        Json kept = Json::object();
        if (object["extensions"].contains(kTextureTransform))
            kept[kTextureTransform] = object["extensions"][kTextureTransform];
        if (kept.empty())
            object.erase("extensions");
        else
            object["extensions"] = kept;
    });
}

// Channels with a pointer extension are invalid without it.
void drop_pointer_channels(Json& json)
{
    if (!json.contains("animations"))
        return;
    Json animations = Json::array();
    for (Json& animation : json["animations"]) {
        Json channels = Json::array();
        for (const Json& channel : animation.at("channels"))
            if (channel.at("target").value("path", std::string()) != "pointer")
                channels.push_back(channel);
        animation["channels"] = channels;
        if (!channels.empty())
            animations.push_back(animation);
    }
    json["animations"] = animations;
    if (animations.empty())
        json.erase("animations");
}

std::set<std::string> extension_names(const Json& json)
{
    std::set<std::string> names;
    for_objects(json, [&](const Json& object) {
        if (const auto found = object.find("extensions");
            found != object.end() && found->is_object())
            for (const auto& [name, extension] : found->items())
                names.insert(name);
    });
    return names;
}

}  // namespace

std::vector<std::size_t> materials_of(const Json& primitive)
{
    std::vector<std::size_t> materials;
    if (primitive.contains("material"))
        materials.push_back(index_of(primitive["material"]));
    for_variants(primitive, [&](const Json& mapping) {
        materials.push_back(index_of(mapping.at("material")));
    });
    return materials;
}

std::set<int> texcoords_read_by(const Json& material)
{
    std::set<int> numbers;
    for_texture_uses(material, [&](const Json& use) {
        const Json* texcoord = texcoord_of(use);
        numbers.insert(texcoord ? int(index_of(*texcoord)) : 0);
    });
    return numbers;
}

std::vector<std::vector<std::size_t>> separate_materials(Json& json,
                                                         std::vector<BakedPrimitive>& baked)
{
    const Json originals = json.value("materials", Json::array());
    std::set<std::size_t> taken = materials_in_use(json);
    std::map<std::tuple<std::optional<std::size_t>, int, bool, int>, std::size_t> copies;
    std::vector<std::vector<std::size_t>> all;

    // The first user of a material keeps it, if no unbaked primitive needs it unchanged.
    const auto copy_of = [&](std::optional<std::size_t> material, const BakedPrimitive& b) {
        const auto [copy, is_new] =
            copies.try_emplace({material, b.moved_texcoord, b.back != nullptr, b.page});
        if (!is_new)
            return copy->second;
        Json own = material ? originals.at(*material) : Json::object();
        drop_lightmap(own);
        if (b.moved_texcoord != kNotMoved)
            renumber_texcoord_1(own, b.moved_texcoord);
        if (b.back)  // its other side is a separate surface
            own.erase("doubleSided");
        if (material && taken.insert(*material).second) {
            copy->second = *material;
            json["materials"][*material] = own;
        } else {
            json["materials"].push_back(own);
            copy->second = json["materials"].size() - 1;
        }
        all.resize(std::max(all.size(), std::size_t(b.page) + 1));
        all[std::size_t(b.page)].push_back(copy->second);
        return copy->second;
    };
    for (BakedPrimitive& b : baked) {
        for (const std::size_t material : b.file_materials)
            b.copies[material] = copy_of(material, b);
        b.material = copy_of(b.material, b);
    }
    return all;
}

std::vector<std::size_t> outdated_lightmaps(const Json& json, const Json& original)
{
    const Json none = Json::array();
    const Json materials = json.value("materials", none), textures = json.value("textures", none);
    std::set<std::size_t> used = lightmap_textures(materials);
    for_texture_uses(materials, [&](const Json& use) { used.insert(index_of(use["index"])); });
    std::vector<std::size_t> outdated;
    for (const std::size_t old : lightmap_textures(original.value("materials", none))) {
        const std::set<std::size_t> images = images_of(textures.at(old));
        const auto shows_them = [&](const Json& texture) {
            const std::set<std::size_t> others = images_of(texture);
            return std::any_of(others.begin(), others.end(),
                               [&](std::size_t image) { return images.contains(image); });
        };
        if (!used.contains(old) && !images.empty() &&
            std::count_if(textures.begin(), textures.end(), shows_them) == 1)
            outdated.push_back(old);
    }
    return outdated;
}

void bind_lightmap(Json& json, const std::vector<std::size_t>& materials, std::size_t texture,
                   float intensity)
{
    for (const std::size_t material : materials)
        json["materials"][material]["extensions"][kLightmapExtension] = {
            {"index", texture}, {"texCoord", 1}, {"intensity", intensity}};
}

void tell_of_lightmap(Json& json, const std::vector<std::size_t>& materials, const Pages& pages,
                      int page)
{
    for (const std::size_t material : materials) {
        Json& own = extras_of(json["materials"][material])[kOwnExtras];
        if (!own.is_object())
            own = Json::object();
        own["lightmap"] = page_name(pages, page, kLightmapName) + ".exr";
        own["texCoord"] = 1;
        if (pages.count > 1)
            own["page"] = page;
    }
}

void reduce_to_core(Json& json, const std::vector<std::vector<std::size_t>>& materials)
{
    for (const std::vector<std::size_t>& of_page : materials)
        for (const std::size_t material : of_page) {
            Json& place = json["materials"][material];
            place = black_material(place);
        }
    erase_extensions(json);
    drop_pointer_channels(json);
    drop_unused_textures(json);
}

void erase_extensions(Json& json)
{
    json.erase("extensions");
    for (auto& [key, part] : json.items())
        erase_extensions(part, key == "textures");
}

void bind_emission(Json& json, const std::vector<std::size_t>& materials, std::size_t texture)
{
    for (const std::size_t material : materials)
        json["materials"][material]["emissiveTexture"] = {{"index", texture}, {"texCoord", 1}};
}

void list_extensions(Json& json, const Json& original)
{
    const std::set<std::string> before = extension_names(original), now = extension_names(json);
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        Json names = Json::array();
        // Some, such as KHR_mesh_quantization, are used without an object of that name.
        for (const Json& name : original.value(key, Json::array()))
            if (!before.contains(name) || now.contains(name))
                names.push_back(name);
        if (key == std::string("extensionsUsed"))
            for (const std::string& name : now)
                if (std::find(names.begin(), names.end(), name) == names.end())
                    names.push_back(name);
        json.erase(key);
        if (!names.empty())
            json[key] = names;
    }
}

}  // namespace lumel
