#include "results/daylight/error_weights.h"

#include <algorithm>
#include <array>

#include "base/core/pi.h"

namespace lumel {
namespace {

/// Light of a lumel that sees a third of the sky [lx].
constexpr float kThird = kPi / 3.0f;
/// Minimum light to which errors are relative, as a fraction of the group's mean.
constexpr double kDim = 0.1;

}  // namespace

std::vector<char> sees_sky(std::span<const float> light)
{
    std::vector<char> found;
    for (const float lux : light)
        found.push_back(lux > kThird ? 1 : 0);
    return found;
}

std::vector<float> error_weights(const SolveScene& scene, std::span<const float> light,
                                 std::span<const char> sees_sky)
{
    struct Group {
        double area = 0.0, light = 0.0;
    };
    std::array<Group, 2> groups;
    const std::vector<Lumel>& lumels = scene.lumels.lumels;
    for (std::size_t i = 0; i < lumels.size(); ++i)
        if (!(lumels[i].flags & kLumelBuried)) {
            Group& group = groups[sees_sky[i] ? 1 : 0];
            group.area += double(lumels[i].area);
            group.light += double(lumels[i].area) * double(light[i]);
        }
    std::vector<float> weights;
    for (std::size_t i = 0; i < lumels.size(); ++i) {
        const Group& group = groups[sees_sky[i] ? 1 : 0];
        const bool counts = !(lumels[i].flags & kLumelBuried) && group.light > 0.0;
        const double least = counts ? kDim * group.light / group.area : 1.0;
        const double own = std::max(double(light[i]), least);
        weights.push_back(counts ? float(double(lumels[i].area) / group.area / (own * own)) : 0.0f);
    }
    return weights;
}

}  // namespace lumel
