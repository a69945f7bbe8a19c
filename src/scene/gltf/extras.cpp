#include "scene/gltf/extras.h"

#include "base/json/json_view.h"

namespace lumel {
namespace {

constexpr const char* kOwnExtras = "lumel";
constexpr const char* kLamps = "lamps";
constexpr double kMin = 1e-6, kMax = 1e9;  // [texels/m]

/// An object member, or nullopt. Extras may have any type.
std::optional<JsonView> object_in(const JsonView& parent, const char* key)
{
    const auto found = parent.find(key);
    return found && found->json().is_object() ? found : std::nullopt;
}

/// extras.lumel.KEY
std::optional<JsonView> own_in_extras(const JsonView& object, const char* key)
{
    const auto extras = object_in(object, kExtras);
    const auto own = extras ? object_in(*extras, kOwnExtras) : std::nullopt;
    return own ? own->find(key) : std::nullopt;
}

}  // namespace

float density_in_extras(const JsonView& object)
{
    const auto density = own_in_extras(object, "texels_per_metre");
    return density ? float(density->number(kMin, kMax)) : 0.0f;
}

bool is_probe_in_extras(const JsonView& node)
{
    const auto probe = own_in_extras(node, "probe");
    return probe && probe->boolean();
}

int page_in_extras(const JsonView& material)
{
    const auto page = own_in_extras(material, "page");
    return page ? int(page->integer(0, kMaxPages - 1)) : 0;
}

std::optional<std::size_t> lamps_view_in_extras(const Json& gltf)
{
    const auto asset = gltf.find("asset");
    const Json* own = asset == gltf.end() ? nullptr : in_extras(*asset, kOwnExtras);
    if (!own || !own->is_object() || !own->contains(kLamps) || !(*own)[kLamps].is_object())
        return std::nullopt;
    const auto view = (*own)[kLamps].find("bufferView");
    if (view == (*own)[kLamps].end() || !view->is_number_unsigned())
        return std::nullopt;
    return view->get<std::size_t>();
}

void forget_lamps(Json& gltf)
{
    if (lamps_view_in_extras(gltf))
        gltf["asset"][kExtras][kOwnExtras].erase(kLamps);
}

const Json* in_extras(const Json& object, const char* key)
{
    if (!object.is_object())
        return nullptr;
    const auto extras = object.find(kExtras);
    if (extras == object.end() || !extras->is_object())
        return nullptr;
    const auto found = extras->find(key);
    return found == extras->end() ? nullptr : &*found;
}

Json& extras_of(Json& object)
{
    Json& extras = object[kExtras];
    if (!extras.is_null() && !extras.is_object())
        extras = Json{{"value", std::move(extras)}};
    return extras;
}

void erase_from_extras(Json& object, const char* key)
{
    Json& extras = object[kExtras];
    extras.erase(key);
    if (extras.empty())
        object.erase(kExtras);
}

void for_primitive_lists(Json& gltf, const std::function<void(Json& primitives)>& visit)
{
    const auto meshes = gltf.find("meshes");
    if (meshes == gltf.end() || !meshes->is_array())
        return;
    for (Json& mesh : *meshes)
        if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
            visit(mesh["primitives"]);
}

}  // namespace lumel
