#include "scene/gltf/split_sides.h"

#include <algorithm>
#include <optional>

#include "scene/gltf/extras.h"

namespace lumel {
namespace {

constexpr const char *kSide = "lumel_side", *kFront = "front", *kBack = "back";

std::optional<MarkedSide> side_mark_of(const Json& primitive)
{
    const Json* side = in_extras(primitive, kSide);
    if (!side)
        return std::nullopt;
    if (*side == kFront)
        return MarkedSide::front;
    return *side == kBack ? std::optional(MarkedSide::back) : std::nullopt;
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
    extras_of(primitive)[kSide] = side == MarkedSide::front ? kFront : kBack;
}

void join_sides(Json& gltf)
{
    for_primitive_lists(gltf, [&](Json& primitives) {
        const auto is_front = [](const Json& p) { return side_mark_of(p) == MarkedSide::front; };
        if (std::none_of(primitives.begin(), primitives.end(), is_front))
            return;
        Json kept = Json::array();
        for (Json& primitive : primitives) {
            const auto mark = side_mark_of(primitive);
            if (mark == MarkedSide::back)
                continue;
            if (mark) {
                make_all_double_sided(gltf, primitive);
                erase_from_extras(primitive, kSide);
            }
            kept.push_back(std::move(primitive));
        }
        primitives = std::move(kept);
    });
}

}  // namespace lumel
