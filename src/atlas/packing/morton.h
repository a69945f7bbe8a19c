#pragma once
// Morton codes: an order that keeps neighbours together.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Interleaves the bits of x and y, x lowest.
inline std::uint64_t morton_code(std::uint32_t x, std::uint32_t y)
{
    std::uint64_t code = 0;
    for (int bit = 0; bit < 16; ++bit)
        code |= std::uint64_t(x >> bit & 1u) << (2 * bit) | std::uint64_t(y >> bit & 1u)
                                                                << (2 * bit + 1);
    return code;
}

/// Code of a point in the unit cube, 16 bits per axis.
inline std::uint64_t morton_code(const glm::dvec3& point)
{
    std::uint64_t code = 0;
    const glm::uvec3 cell(glm::clamp(point, 0.0, 1.0) * 65535.0);
    for (int bit = 0; bit < 16; ++bit)
        for (int axis = 0; axis < 3; ++axis)
            code |= std::uint64_t(cell[axis] >> bit & 1u) << (3 * bit + axis);
    return code;
}

}  // namespace lumel
