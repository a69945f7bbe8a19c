#include "results/picture/page_layers.h"

#include <algorithm>
#include <cmath>

#include "base/core/lattice.h"
#include "base/images/tone_curve.shared.h"

namespace lumel {
namespace {

constexpr float kMidGrey = 0.18f;
constexpr float kWhiteCode = 255.0f;

/// In [0, 1): values of adjacent pixels, and of the layers at a pixel, are spread evenly [Rob18].
float threshold(int x, int y, std::uint32_t layer)
{
    // 2³² / ψ, / ψ², / φ; ψ³ = ψ + 1
    constexpr std::uint32_t kX = 3242174889u, kY = 2447445414u, kLayer = 2654435769u;
    return unit_float(std::uint32_t(x) * kX + std::uint32_t(y) * kY + layer * kLayer);
}

/// k: mid grey shows as tone_curve() shows it, at a code of at least 1/2, where n is its square.
float steepness()
{
    const float code = tone_curve(glm::vec3(kMidGrey)).g;
    return -std::log(1.0f - code * code) / kMidGrey;
}

}  // namespace

Image page_layer(const Image& radiance, float exposure, std::uint32_t number)
{
    const float k = steepness() * exposure;
    Image layer(radiance.width, radiance.height, 3);
    for (int y = 0; y < layer.height; ++y)
        for (int x = 0; x < layer.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float n = 1.0f - std::exp(-k * std::max(radiance.at(x, y)[c], 0.0f));
                layer.at(x, y)[c] =
                    std::floor(n * kWhiteCode + threshold(x, y, number)) / kWhiteCode;
            }
    return layer;
}

}  // namespace lumel
