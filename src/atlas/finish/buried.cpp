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

bool is_black(const Image& map, std::size_t texel)
{
    const float* rgb = map.values.data() + texel * 4;
    return rgb[0] == 0.0f && rgb[1] == 0.0f && rgb[2] == 0.0f;
}

}  // namespace

void fill_buried(Image& map, const Lumels& lumels, std::span<Image> layers)
{
    const std::size_t count = std::size_t(map.width) * std::size_t(map.height);
    std::vector<std::uint32_t> charts(count, kOutsideCharts);
    std::vector<std::uint8_t> open(count), buried(count);
    for (const Lumel& lumel : lumels.lumels) {
        const std::uint32_t texel = map_texel(lumels, lumel);
        charts[texel] = map_chart(lumels, lumel);
        (lumel.flags & kLumelBuried ? buried : open)[texel] = 1;
    }

    std::vector<TexelState> states(count, TexelState::outside);
    for (std::size_t texel = 0; texel < count; ++texel)
        if (buried[texel] && (!open[texel] || is_black(map, texel)))
            states[texel] = TexelState::wanted;
        else if (open[texel])
            states[texel] = TexelState::known;
    for (Image& layer : layers)
        grow(layer, states, charts);
    grow(map, std::move(states), charts);
}

}  // namespace lumel
