#include "base/core/box.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Minimum magnitude of a direction component, so that inverses are finite.
constexpr float kMinPart = 1e-20f;

/// Clips first <= t <= last to a + t (b - a) <= most.
void keep_below(float a, float b, float most, float& first, float& last)
{
    if (a <= most && b <= most)
        return;
    if (a > most && b > most) {
        last = -1.0f;
        return;
    }
    const float t = (most - a) / (b - a);
    if (a <= most)
        last = std::min(last, t);
    else
        first = std::max(first, t);
}

}  // namespace

bool Box::may_meet(const glm::vec3& origin, const glm::vec3& direction, float far,
                   float margin) const
{
    float enter = 0.0f, leave = far;
    for (int c = 0; c < 3; ++c) {
        const float inverse = 1.0f / (std::abs(direction[c]) > kMinPart ? direction[c] : kMinPart);
        const float a = (low[c] - margin - origin[c]) * inverse;
        const float b = (high[c] + margin - origin[c]) * inverse;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

bool Box::may_lie_between(const Box& from, const Box& to) const
{
    float first = 0.0f, last = 1.0f;
    for (int c = 0; c < 3; ++c) {
        keep_below(from.low[c], to.low[c], high[c], first, last);
        keep_below(-from.high[c], -to.high[c], -low[c], first, last);
    }
    return first <= last;
}

}  // namespace lumel
