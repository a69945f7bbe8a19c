#pragma once
// A point at the origin that faces +z, and plates above it that shine down.

#include <glm/glm.hpp>

#include "../support/box_lumels.h"
#include "lights/sources.h"

namespace lumel::support {

inline RayOrigin upward()
{
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    return {.position = glm::vec3(0.0f), .normal = up, .geometric = up, .cell = 0};
}

/// The rectangle x × y at z = height, which shines down.
inline Quad plate_above(const glm::vec2& low, const glm::vec2& high, float height,
                        const glm::vec3& emission)
{
    Quad plate;
    plate.corner = {low.x, low.y, height};
    plate.edge_u = {0.0f, high.y - low.y, 0.0f};
    plate.edge_v = {high.x - low.x, 0.0f, 0.0f};
    plate.albedo = glm::vec3(0.0f);
    plate.emission = emission;
    return plate;
}

/// Calls visit(at) for points of the unit square on a grid of side².
template <typename Visit>
void for_square(int side, const Visit& visit)
{
    for (int k = 0; k < side * side; ++k)
        visit((glm::vec2(k % side, k / side) + 0.5f) / float(side));
}

/// Mean [lx] of the samples of a source, as if nothing were between.
inline glm::dvec3 mean_of_samples(const LightSources& sources, std::size_t source,
                                  const RayOrigin& start, int side = 128)
{
    glm::dvec3 sum(0.0);
    for_square(side, [&](const glm::vec2& at) {
        sum += glm::dvec3(sources.sample(source, start, at).irradiance);
    });
    return sum / double(side * side);
}

}  // namespace lumel::support
