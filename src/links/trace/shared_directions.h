#pragma once
// Directions that many lumels send their rays along.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Sets of directions, each spread evenly over the sphere and turned at random. Lumels whose places
/// in the atlas repeat after `side` texels share a set. One set for all would leave its pattern in
/// the light, with edges that no filter removes.
class SharedDirections {
public:
    /// rays: that a lumel sends out, in the mean.
    SharedDirections(std::uint32_t side, double rays, std::uint32_t seed);

    std::span<const glm::vec3> all() const { return directions_; }
    std::uint32_t set(std::uint32_t x, std::uint32_t y) const  ///< of a texel
    {
        return y % side_ * side_ + x % side_;
    }
    std::uint32_t first(std::uint32_t set) const { return set * per_set_; }
    std::uint32_t per_set() const { return per_set_; }

private:
    std::uint32_t side_, per_set_;
    std::vector<glm::vec3> directions_;  ///< [sets][per_set], neighbours mostly together
};

/// Draws directions of a set for one lumel, in proportion to the cosine.
class CosineDraw {
public:
    /// directions must outlive it.
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
    glm::vec3 normal_{0.0f};    ///< that below_ is of
    std::vector<float> below_;  ///< [per_set] Σ cosines up to each
};

}  // namespace lumel
