#include "scene/gltf/split_sides.h"

#include <algorithm>
#include <optional>
#include <string>

namespace lumel {
namespace {

constexpr const char *kExtras = "extras", *kSide = "lumel_side", *kFront = "front", *kBack = "back";

std::optional<MarkedSide> mark_of(const Json& primitive)
{
    if (!primitive.is_object())
        return std::nullopt;
    const auto extras = primitive.find(kExtras);
    if (extras == primitive.end() || !extras->is_object() || !extras->contains(kSide))
        return std::nullopt;
    const Json& side = (*extras)[kSide];
    if (side == kFront)
        return MarkedSide::front;
    return side == kBack ? std::optional(MarkedSide::back) : std::nullopt;
}

void erase_mark(Json& primitive)
{
    Json& extras = primitive[kExtras];
    extras.erase(kSide);
    if (extras.empty())
        primitive.erase(kExtras);
}

/// `user`: an object with a material index, i.e. a primitive or a mapping of material variants.
void make_double_sided(Json& materials, const Json& user)
{
    if (!user.is_object() || !user.contains("material") || !user["material"].is_number_unsigned())
        return;
    const auto material = user["material"].get<std::size_t>();
    if (material < materials.size() && materials[material].is_object())
        materials[material]["doubleSided"] = true;
}

void make_all_double_sided(Json& gltf, const Json& primitive)
{
    const auto materials = gltf.find("materials");
    if (materials == gltf.end() || !materials->is_array())
        return;
    make_double_sided(*materials, primitive);
    const Json::json_pointer mappings("/extensions/KHR_materials_variants/mappings");
    if (primitive.contains(mappings) && primitive[mappings].is_array())
        for (const Json& mapping : primitive[mappings])
            make_double_sided(*materials, mapping);
}

}  // namespace

void mark_side(Json& primitive, MarkedSide side)
{
    Json& extras = primitive[kExtras];
    if (!extras.is_null() && !extras.is_object())
        extras = Json{{"value", std::move(extras)}};
    extras[kSide] = side == MarkedSide::front ? kFront : kBack;
}

void join_sides(Json& gltf)
{
    const auto meshes = gltf.find("meshes");
    if (meshes == gltf.end() || !meshes->is_array())
        return;
    for (std::size_t m = 0; m < meshes->size(); ++m) {
        Json& mesh = (*meshes)[m];
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array())
            continue;
        Json& primitives = mesh["primitives"];
        const auto is_front = [](const Json& p) { return mark_of(p) == MarkedSide::front; };
        if (std::none_of(primitives.begin(), primitives.end(), is_front))
            continue;
        Json kept = Json::array();
        for (Json& primitive : primitives) {
            const auto mark = mark_of(primitive);
            if (mark == MarkedSide::back)
                continue;
            if (mark) {
                make_all_double_sided(gltf, primitive);
                erase_mark(primitive);
            }
            kept.push_back(std::move(primitive));
        }
        primitives = std::move(kept);
    }
}

}  // namespace lumel
