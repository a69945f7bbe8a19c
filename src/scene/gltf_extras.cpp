#include "scene/gltf_extras.h"

namespace lumel {
namespace {

constexpr double kLeast = 1e-6, kMost = 1e9;  // [texels/m]

/// A member that is an object. Extras may be anything.
std::optional<JsonView> object_in(const JsonView& parent, const char* key)
{
    const auto found = parent.find(key);
    return found && found->json().is_object() ? found : std::nullopt;
}

}  // namespace

float density_in_extras(const JsonView& object)
{
    const auto extras = object_in(object, "extras");
    const auto own = extras ? object_in(*extras, "lumel") : std::nullopt;
    const auto density = own ? own->find("texels_per_metre") : std::nullopt;
    return density ? float(density->number(kLeast, kMost)) : 0.0f;
}

}  // namespace lumel
