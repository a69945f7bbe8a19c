#pragma once
// Luminance of colours.

#include <glm/glm.hpp>

namespace lumel {

/// Luminance of linear RGB with Rec. 709 primaries, in the unit of `color`.
inline double luminance(const glm::vec3& color)
{
    return 0.2126 * double(color.r) + 0.7152 * double(color.g) + 0.0722 * double(color.b);
}

inline float sum_of(const glm::vec3& color)
{
    return color.r + color.g + color.b;
}

}  // namespace lumel
