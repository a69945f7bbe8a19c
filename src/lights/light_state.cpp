#include "lights/light_state.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/json/json_view.h"

namespace lumel {
namespace {

/// Maximum distance of lamps [m], as for meshes.
constexpr double kFarthest = 1e9;
/// Minimum length of a direction vector.
constexpr float kMinLength = 1e-20f;

std::string list_of(const std::vector<std::string>& names)
{
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + lumel::quoted(name);
    return list;
}

[[noreturn]] void refuse(const PunctualLight& lamp, const std::string& what)
{
    throw Error(ErrorKind::input, "", lumel::quoted(lamp.name) + " " + what);
}

}  // namespace

void check_factor(const std::string& name, const glm::vec3& factor)
{
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(factor[c]) || factor[c] < 0.0f)
            throw Error(ErrorKind::input, "",
                        "the factor of " + lumel::quoted(name) + " is not a number of 0 or more");
}

std::vector<std::string> SourceNames::names() const
{
    std::vector<std::string> names;
    for (const Source& source : sources_)
        names.push_back(source.name);
    return names;
}

std::vector<std::size_t> SourceNames::of(const std::string& name) const
{
    std::vector<std::size_t> named, shining;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        const std::vector<std::string>& materials = sources_[s].materials;
        if (sources_[s].name == name)
            named.push_back(s);
        if (std::find(materials.begin(), materials.end(), name) != materials.end())
            shining.push_back(s);
    }
    if (named.empty() && shining.empty())
        throw Error(ErrorKind::input, "",
                    "there is no light " + lumel::quoted(name) + "; there are " +
                        (sources_.empty() ? "none at all" : list_of(names())));
    return named.empty() ? shining : named;
}

std::vector<glm::vec3> SourceNames::factors(const LightState& state) const
{
    check_factor("others", state.others);
    std::vector<glm::vec3> factors(sources_.size(), state.others);
    std::vector<std::string> set_by(factors.size());
    for (const auto& [name, factor] : state.lights) {
        check_factor(name, factor);
        for (const std::size_t s : of(name)) {
            if (!set_by[s].empty())
                throw Error(ErrorKind::input, "",
                            lumel::quoted(set_by[s]) + " and " + lumel::quoted(name) +
                                " are the same light");
            set_by[s] = name;
            factors[s] = factor;
        }
    }
    return factors;
}

PunctualLight placed(PunctualLight lamp, const LampPlace& place, const glm::dvec3& origin)
{
    if (place.turn)
        refuse(lamp, "is no sky, which alone has a \"turn\"");
    if (place.position) {
        if (lamp.kind == PunctualLight::Kind::directional)
            refuse(lamp, "is a directional light: it has a direction and no position");
        const glm::dvec3 position = *place.position - origin;
        if (!(glm::length(position) < kFarthest))
            refuse(lamp, "would be too far out");
        lamp.transform[3] = glm::vec4(glm::vec3(position), 1.0f);
    }
    if (place.direction) {
        const float length = glm::length(*place.direction);
        if (!std::isfinite(length) || length < kMinLength)
            refuse(lamp, "has a direction of no length");
        const glm::vec4 position = lamp.transform[3];
        lamp.transform = glm::mat4(frame_about(*place.direction / -length));
        lamp.transform[3] = position;
    }
    return lamp;
}

}  // namespace lumel
