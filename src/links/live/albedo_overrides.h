#pragma once
// Albedos of lumels whose materials change their colour.

#include <cstdint>
#include <map>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

class AlbedoOverrides {
public:
    explicit AlbedoOverrides(const Lumels& lumels);

    /// A material reflects with this base colour times its texture. Scene and atlas: those of the
    /// lumels.
    void set(const Scene& scene, const Atlas& atlas, int material, const glm::vec3& colour);

    const std::vector<glm::vec3>& albedo() const { return albedo_; }  ///< [N] 0…1

private:
    /// What one of a material's lumels reflects is linear in its colour.
    struct Share {
        std::uint32_t lumel;
        glm::vec3 per_colour;
    };
    struct Coat {
        glm::vec3 colour;  ///< now
        std::vector<Share> shares;
    };
    Coat coat_of(const Scene& scene, const Atlas& atlas, int material) const;

    std::vector<glm::vec3> unclamped_;  ///< [N]
    std::vector<glm::vec3> albedo_;     ///< [N]
    std::map<int, Coat> coats_;         ///< of materials that have been painted
};

}  // namespace lumel
