#pragma once
// How bright a colour is.

#include <glm/glm.hpp>

namespace lumel {

/// Luminance of linear RGB with Rec. 709 primaries, in the colour's own unit.
inline double luminance(const glm::vec3& color)
{
    return 0.2126 * double(color.r) + 0.7152 * double(color.g) + 0.0722 * double(color.b);
}

}  // namespace lumel
