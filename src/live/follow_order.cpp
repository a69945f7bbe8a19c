#include "live/follow_order.h"

#include <algorithm>
#include <array>

namespace lumel {
namespace {

/// Distances at which shells end, in radii of the ball around the thing; the last has all the rest.
constexpr std::array<float, 3> kShells{0.5f, 1.0f, 2.0f};

}  // namespace

std::size_t FollowOrder::end_after(std::size_t place) const
{
    return *std::upper_bound(ends.begin(), ends.end() - 1, place);
}

bool FollowOrder::ends_at(std::size_t place) const
{
    return std::binary_search(ends.begin(), ends.end(), place);
}

FollowOrder follow_order(const WorldLumels& world, const Box& box)
{
    std::array<float, kShells.size()> bounds{};
    for (std::size_t s = 0; s < bounds.size(); ++s)
        bounds[s] = kShells[s] * kShells[s] * box.radius() * box.radius();
    const auto shell_of = [&](std::size_t i) {
        const float distance2 = box.distance2(world[i].centre);
        return std::size_t(std::upper_bound(bounds.begin(), bounds.end(), distance2) -
                           bounds.begin());
    };
    std::array<std::vector<std::uint32_t>, kShells.size() + 1> shells;
    for (std::size_t i = 0; i < world.size(); ++i)
        shells[shell_of(i)].push_back(std::uint32_t(i));
    FollowOrder order;
    order.lumels.reserve(world.size());
    for (const std::vector<std::uint32_t>& shell : shells)
        if (!shell.empty()) {
            order.lumels.insert(order.lumels.end(), shell.begin(), shell.end());
            order.ends.push_back(order.lumels.size());
        }
    return order;
}

}  // namespace lumel
