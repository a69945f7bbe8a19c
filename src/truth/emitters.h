#pragma once
// Emissive triangles of a scene as light sources, sampled by power.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "rays/paths/surfaces.h"

namespace lumel {

/// A point of an emitter, drawn with `density` per area.
struct EmitterPoint {
    glm::vec3 position{0.0f};   ///< world [m]
    glm::vec3 normal{0.0f};     ///< front normal, unit, world
    glm::vec3 luminance{0.0f};  ///< emitted × opacity [cd/m²]
    float density = 0.0f;       ///< [1/m²]
    bool double_sided = false;  ///< emits from its back as well
    float reach = 0.0f;         ///< of its triangle [m], see ray_offset_for()
};

class Emitters {
public:
    /// `surfaces` must outlive this.
    explicit Emitters(const Surfaces& surfaces);

    bool empty() const { return triangles_.empty(); }

    /// Maps a point of the unit square to one on an emitter. Requires !empty().
    EmitterPoint sample(const glm::vec2& at) const;

    /// Density [1/m²] of `sample` on a triangle; 0 if it is never sampled.
    float density(std::size_t surface, std::uint32_t triangle) const
    {
        const std::vector<float>& densities = densities_[surface];
        return densities.empty() ? 0.0f : densities[triangle];
    }

private:
    struct Triangle {
        std::size_t surface = 0;
        std::uint32_t triangle = 0;
        glm::vec3 corner{0.0f};  ///< world [m]
        glm::vec3 edge_u{0.0f};
        glm::vec3 edge_v{0.0f};
        glm::vec3 normal{0.0f};
        float density = 0.0f;
        float reach = 0.0f;
    };

    void add(std::size_t surface, std::vector<double>& powers);

    const Surfaces* surfaces_;
    std::vector<Triangle> triangles_;
    std::vector<double> running_;                ///< cumulative probabilities, the last is 1
    std::vector<std::vector<float>> densities_;  ///< [surfaces][triangles], empty: does not emit
};

}  // namespace lumel
