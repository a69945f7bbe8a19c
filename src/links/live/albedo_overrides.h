#pragma once
// Albedos of lumels whose material colours are overridden.

#include <cstdint>
#include <map>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

class AlbedoOverrides {
public:
    explicit AlbedoOverrides(const Lumels& lumels);

    /// Sets the base colour of a material, which is multiplied by its texture. `scene` and `atlas`
    /// belong to the lumels.
    void set(const Scene& scene, const Atlas& atlas, int material, const glm::vec3& colour);

    /// Sets the base colours of materials that are overridden.
    void paint(std::vector<Material>& materials) const;

    const std::vector<glm::vec3>& albedo() const { return albedo_; }  ///< [N] capped

private:
    /// Albedo of a lumel per colour of its material: linear.
    struct Share {
        std::uint32_t lumel;
        glm::vec3 per_colour;
    };
    struct Coat {
        glm::vec3 colour;  ///< current
        std::vector<Share> shares;
    };
    Coat coat_of(const Scene& scene, const Atlas& atlas, int material) const;

    std::vector<glm::vec3> uncapped_;  ///< [N], empty before the first override
    std::vector<glm::vec3> albedo_;    ///< [N]
    std::map<int, Coat> coats_;        ///< by material
};

}  // namespace lumel
