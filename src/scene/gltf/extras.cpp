#include "scene/gltf/extras.h"

#include "base/json/json_view.h"

namespace lumel {
namespace {

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
    const auto extras = object_in(object, "extras");
    const auto own = extras ? object_in(*extras, "lumel") : std::nullopt;
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

}  // namespace lumel
