#include "results/picture/page_layers.h"

#include <algorithm>
#include <cmath>

#include "base/images/tone_curve.shared.h"

namespace lumel {
namespace {

constexpr float kMidGrey = 0.18f;

/// k: mid grey shows as tone_curve() shows it, at a code of at least 1/2, where n is its square.
float steepness()
{
    const float code = tone_curve(glm::vec3(kMidGrey)).g;
    return -std::log(1.0f - code * code) / kMidGrey;
}

}  // namespace

Image page_layer(const Image& radiance, float exposure)
{
    const float k = steepness() * exposure;
    Image layer(radiance.width, radiance.height, 3);
    for (std::size_t i = 0; i < radiance.values.size() / 4; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            layer.values[3 * i + c] =
                1.0f - std::exp(-k * std::max(radiance.values[4 * i + c], 0.0f));
    return layer;
}

float shown_below_white(float layer)
{
    return layer >= 0.25f ? std::sqrt(layer) : ((16.0f * layer - 12.0f) * layer + 4.0f) * layer;
}

}  // namespace lumel
