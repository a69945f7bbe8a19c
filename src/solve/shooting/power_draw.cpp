#include "solve/shooting/power_draw.h"

#include <algorithm>

namespace lumel {

PowerDraw::PowerDraw(const WorldLumels& world, const Lumels& lumels, std::vector<float> brightness)
    : world_(&world),
      brightness_(std::move(brightness)),
      running_(brightness_.size())
{
    double sum = 0.0;
    for (std::size_t i = 0; i < brightness_.size(); ++i) {
        if ((lumels.lumels[i].flags & kLumelBuried) != 0)
            brightness_[i] = 0.0f;
        sum += double(lumels.lumels[i].area) * double(brightness_[i]);
        running_[i] = sum;
    }
}

std::uint32_t PowerDraw::lumel(double place) const
{
    const auto above = std::upper_bound(running_.begin(), running_.end(), place);
    // Rounding may lead past the last lumel with power.
    const auto last = std::lower_bound(running_.begin(), running_.end(), running_.back());
    return std::uint32_t(std::min(above, last) - running_.begin());
}

}  // namespace lumel
