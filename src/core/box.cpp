#include "core/box.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Directions have no smaller parts, so that their inverses are finite.
constexpr float kLeastPart = 1e-20f;

}  // namespace

bool Box::may_meet(const glm::vec3& origin, const glm::vec3& direction, float far,
                   float margin) const
{
    float enter = 0.0f, leave = far;
    for (int c = 0; c < 3; ++c) {
        const float inverse =
            1.0f / (std::abs(direction[c]) > kLeastPart ? direction[c] : kLeastPart);
        const float a = (low[c] - margin - origin[c]) * inverse;
        const float b = (high[c] + margin - origin[c]) * inverse;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

}  // namespace lumel
