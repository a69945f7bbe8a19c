#pragma once
// Ray directions shared by many lumels.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Directions spread evenly over the sphere and randomly rotated, of which each lumel draws a few.
class SharedDirections {
public:
    /// rays: per lumel, on average.
    SharedDirections(double rays, std::uint32_t seed);

    std::span<const glm::vec3> all() const { return directions_; }

private:
    std::vector<glm::vec3> directions_;  ///< mostly sorted by neighbours
};

/// Draws directions for a lumel, with probability proportional to the cosine.
class CosineDraw {
public:
    /// directions must outlive this.
    explicit CosineDraw(const SharedDirections& directions)
        : directions_(&directions),
          below_(directions.all().size())
    {
    }

    /// Index of a direction. Even numbers `at` in [0, 1) spread over those above the surface.
    std::uint32_t draw(const glm::vec3& normal, float at);

private:
    const SharedDirections* directions_;
    glm::vec3 normal_{0.0f};    ///< normal that below_ was computed for
    std::vector<float> below_;  ///< [directions] cumulative cosines
};

}  // namespace lumel
