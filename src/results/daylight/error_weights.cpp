#include "results/daylight/error_weights.h"

#include <algorithm>
#include <array>

namespace lumel {
namespace {

/// Least light that errors are relative to, as part of the mean of lumels that are open to the
/// sky, or of others.
constexpr double kDim = 0.1;

}  // namespace

std::vector<float> error_weights(const SolveScene& scene, std::span<const float> light,
                                 std::span<const char> open)
{
    struct Zone {
        double area = 0.0, light = 0.0;
    };
    std::array<Zone, 2> zones;
    const std::vector<Lumel>& lumels = scene.lumels.lumels;
    for (std::size_t i = 0; i < lumels.size(); ++i)
        if (!(lumels[i].flags & kLumelBuried)) {
            Zone& zone = zones[open[i] ? 1 : 0];
            zone.area += double(lumels[i].area);
            zone.light += double(lumels[i].area) * double(light[i]);
        }
    std::vector<float> weights;
    for (std::size_t i = 0; i < lumels.size(); ++i) {
        const Zone& zone = zones[open[i] ? 1 : 0];
        const bool counts = !(lumels[i].flags & kLumelBuried) && zone.light > 0.0;
        const double least = counts ? kDim * zone.light / zone.area : 1.0;
        const double own = std::max(double(light[i]), least);
        weights.push_back(counts ? float(double(lumels[i].area) / zone.area / (own * own)) : 0.0f);
    }
    return weights;
}

}  // namespace lumel
