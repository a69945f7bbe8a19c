#pragma once
// Ray directions shared by many lumels.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Sets of directions, each spread evenly over the sphere and randomly rotated. Lumels share a set
/// if their atlas positions are equal modulo `side` texels. A single set would leave visible
/// patterns with edges that the filter keeps.
class SharedDirections {
public:
    /// rays: per lumel, on average.
    SharedDirections(std::uint32_t side, double rays, std::uint32_t seed);

    std::span<const glm::vec3> all() const { return directions_; }
    std::uint32_t set(std::uint32_t x, std::uint32_t y) const  ///< set of a texel
    {
        return y % side_ * side_ + x % side_;
    }
    std::uint32_t first(std::uint32_t set) const { return set * per_set_; }
    std::uint32_t per_set() const { return per_set_; }

private:
    std::uint32_t side_, per_set_;
    std::vector<glm::vec3> directions_;  ///< [sets][per_set], mostly sorted by neighbours
};

/// Draws directions of a set for a lumel, with probability proportional to the cosine.
class CosineDraw {
public:
    /// directions must outlive this.
    CosineDraw(const SharedDirections& directions, std::uint32_t set)
        : directions_(&directions),
          first_(directions.first(set)),
          below_(directions.per_set())
    {
    }

    /// Index of a direction. Even numbers `at` in [0, 1) spread over those above the surface.
    std::uint32_t draw(const glm::vec3& normal, float at);

private:
    const SharedDirections* directions_;
    std::uint32_t first_;
    glm::vec3 normal_{0.0f};    ///< normal that below_ was computed for
    std::vector<float> below_;  ///< [per_set] cumulative cosines
};

}  // namespace lumel
