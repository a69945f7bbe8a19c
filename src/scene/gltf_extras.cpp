#include "scene/gltf_extras.h"

namespace lumel {
namespace {

constexpr int kMostPages = 256;
constexpr double kLeast = 1e-6, kMost = 1e9;  // [texels/m]

/// A member that is an object. Extras may be anything.
std::optional<JsonView> object_in(const JsonView& parent, const char* key)
{
    const auto found = parent.find(key);
    return found && found->json().is_object() ? found : std::nullopt;
}

std::optional<JsonView> own_extras(const JsonView& object)
{
    const auto extras = object_in(object, "extras");
    return extras ? object_in(*extras, "lumel") : std::nullopt;
}

}  // namespace

float density_in_extras(const JsonView& object)
{
    const auto own = own_extras(object);
    const auto density = own ? own->find("texels_per_metre") : std::nullopt;
    return density ? float(density->number(kLeast, kMost)) : 0.0f;
}

int page_in_extras(const JsonView& material)
{
    const auto own = own_extras(material);
    const auto page = own ? own->find("page") : std::nullopt;
    return page ? int(page->integer(0, kMostPages - 1)) : 0;
}

}  // namespace lumel
