#pragma once
// Lighting states: factors by source name, and positions of lamps.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/scene.h"

namespace lumel {

/// Position and direction of a lamp in the world of the scene's file.
struct LampPlace {
    std::optional<glm::dvec3> position;  ///< [m] of point and spot lights; none: as baked
    std::optional<glm::vec3> direction;  ///< direction of its light, any length; none: as baked
    /// Rotation of the sky about +y relative to the bake, counter-clockwise from above [degrees].
    /// Stored links only.
    std::optional<double> turn;
};

/// Factors by names of sources or of emissive materials, and lamp positions.
struct LightState {
    glm::vec3 others{1.0f};  ///< factor of unnamed sources
    std::map<std::string, glm::vec3> lights;
    std::map<std::string, LampPlace> places;
};

/// Sources by name, and by the names of their emissive materials.
class SourceNames {
public:
    struct Source {
        std::string name;
        std::vector<std::string> materials;
    };

    SourceNames() = default;
    explicit SourceNames(std::vector<Source> sources) : sources_(std::move(sources)) {}

    std::vector<std::string> names() const;
    /// Indices of the sources with that name. Throws Error{input}, with the valid names, for an
    /// unknown name.
    std::vector<std::size_t> of(const std::string& name) const;
    /// [sources] Factors. Throws Error{input} for an unknown name, for factors that are negative or
    /// not finite, and if two names denote the same source.
    std::vector<glm::vec3> factors(const LightState& state) const;

private:
    std::vector<Source> sources_;
};

/// Throws Error{input} if a factor is negative or not finite.
void check_factor(const std::string& name, const glm::vec3& factor);

/// Returns the moved lamp. origin: of its scene. Throws Error{input} for positions of directional
/// lights, directions without length, and positions that are too far out.
PunctualLight placed(PunctualLight lamp, const LampPlace& place, const glm::dvec3& origin);

}  // namespace lumel
