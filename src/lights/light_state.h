#pragma once
// What states of lights ask for: factors by the names of sources, and places of lamps.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/scene.h"

namespace lumel {

/// Where a lamp is, in the world of the scene's file.
struct LampPlace {
    std::optional<glm::dvec3> position;  ///< [m] of point and spot lights; none: as baked
    std::optional<glm::vec3> direction;  ///< in which it shines, of any length; none: as baked
    /// Of the sky about +y, counter-clockwise as seen from above, from how it was baked [degrees].
    /// Only over kept links.
    std::optional<double> turn;
};

/// Factors to the light of sources, by the sources' names or by those of materials that shine; and
/// places of lamps.
struct LightState {
    glm::vec3 others{1.0f};  ///< of sources that are not named
    std::map<std::string, glm::vec3> lights;
    std::map<std::string, LampPlace> places;
};

/// Sources by their names, and by those of materials that make them shine.
class SourceNames {
public:
    struct Source {
        std::string name;
        std::vector<std::string> materials;
    };

    SourceNames() = default;
    explicit SourceNames(std::vector<Source> sources) : sources_(std::move(sources)) {}

    std::vector<std::string> names() const;
    /// Their numbers. Throws Error{input}, with the names that there are, for another name.
    std::vector<std::size_t> of(const std::string& name) const;
    /// [sources] Factors. Throws Error{input} for another name, for factors that are negative or no
    /// numbers, and where two names mean the same source.
    std::vector<glm::vec3> factors(const LightState& state) const;

private:
    std::vector<Source> sources_;
};

/// Throws Error{input} for a factor that is negative or no number.
void check_factor(const std::string& name, const glm::vec3& factor);

/// A lamp elsewhere. origin: of its scene. Throws Error{input} for positions of directional lights,
/// directions that are none, and places too far away.
PunctualLight placed(PunctualLight lamp, const LampPlace& place, const glm::dvec3& origin);

}  // namespace lumel
