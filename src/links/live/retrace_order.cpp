#include "links/live/retrace_order.h"

#include <algorithm>
#include <array>

namespace lumel {
namespace {

/// Outer radii of the distance bands, in bounding radii of the object; the last band is unbounded.
constexpr std::array<float, 3> kEnds{0.5f, 1.0f, 2.0f};
/// Index of the band of lumels on the object, after the closest; number of bands.
constexpr std::size_t kOwn = 1, kShells = kEnds.size() + 2;

}  // namespace

std::size_t RetraceOrder::end_after(std::size_t place) const
{
    return *std::upper_bound(ends.begin(), ends.end() - 1, place);
}

bool RetraceOrder::ends_at(std::size_t place) const
{
    return std::binary_search(ends.begin(), ends.end(), place);
}

RetraceOrder follow_order(const WorldLumels& world, std::span<const std::uint32_t> own,
                          const Box& box)
{
    std::array<float, kEnds.size()> bounds{};  // squared [m²]
    for (std::size_t s = 0; s < bounds.size(); ++s)
        bounds[s] = kEnds[s] * kEnds[s] * box.radius() * box.radius();
    std::vector<char> is_own(world.size(), 0);
    for (const std::uint32_t i : own)
        is_own[i] = 1;
    const auto shell_of = [&](std::size_t i) {
        const float distance2 = box.distance2(world[i].centre);
        const auto s =
            std::size_t(std::upper_bound(bounds.begin(), bounds.end(), distance2) - bounds.begin());
        return is_own[i] != 0 ? kOwn : s < kOwn ? s : s + 1;
    };
    std::array<std::vector<std::uint32_t>, kShells> shells;
    for (std::size_t i = 0; i < world.size(); ++i)
        shells[shell_of(i)].push_back(std::uint32_t(i));
    RetraceOrder order;
    order.lumels.reserve(world.size());
    order.near = shells[0].size() + shells[kOwn].size();
    for (const std::vector<std::uint32_t>& shell : shells)
        if (!shell.empty()) {
            order.lumels.insert(order.lumels.end(), shell.begin(), shell.end());
            order.ends.push_back(order.lumels.size());
        }
    return order;
}

}  // namespace lumel
