// A buried lumel receives no light and is invisible, but filtering mixes it with the visible texel
// beside it. So it gets its neighbours' light, only from its own chart: an adjacent chart in the
// atlas may be in another room.

#include <cstddef>
#include <limits>

#include "atlas/finish/finish.h"
#include "atlas/finish/grow.h"
#include "atlas/lumels/sides.h"

namespace lumel {
namespace {

constexpr std::uint32_t kOutsideCharts = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void fill_buried(Image& map, const Lumels& lumels, std::span<const std::uint32_t> shown,
                 std::span<Image> layers)
{
    const std::size_t count = std::size_t(map.width) * std::size_t(map.height);
    std::vector<std::uint32_t> charts(count, kOutsideCharts);
    std::vector<TexelState> states(count, TexelState::outside);
    for (std::size_t texel = 0; texel < count; ++texel) {
        if (shown[texel] == kNoLumel)
            continue;
        const Lumel& lumel = lumels.lumels[shown[texel]];
        charts[texel] = map_chart(lumels, lumel);
        states[texel] = lumel.flags & kLumelBuried ? TexelState::wanted : TexelState::known;
    }
    for (Image& layer : layers)
        grow(layer, states, charts);
    grow(map, std::move(states), charts);
}

}  // namespace lumel
