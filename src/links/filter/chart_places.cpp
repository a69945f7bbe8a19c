#include "links/filter/chart_places.h"

#include <algorithm>
#include <limits>

#include "atlas/lumels/sides.h"

namespace lumel {

std::vector<ChartPlace> chart_places(const Lumels& lumels)
{
    std::vector<ChartPlace> all;
    for (const Lumel& lumel : lumels.lumels) {
        const std::size_t key = place_by_side(lumel.chart, is_back(lumel));
        for (std::size_t n = all.size(); n <= key; ++n)
            all.push_back({glm::ivec2(std::numeric_limits<int>::max()), glm::ivec2(-1),
                           std::uint32_t(n / 2), n % 2 == 1});
        const glm::ivec2 at(int(lumel.texel) % lumels.width, int(lumel.texel) / lumels.width);
        all[key].low = glm::min(all[key].low, at);
        all[key].high = glm::max(all[key].high, at);
    }
    std::erase_if(all, [](const ChartPlace& place) { return place.high.x < place.low.x; });
    const auto texels = [](const ChartPlace& place) {
        const glm::ivec2 size = place.high - place.low + 1;
        return std::size_t(size.x) * std::size_t(size.y);
    };
    std::stable_sort(all.begin(), all.end(), [&](const ChartPlace& a, const ChartPlace& b) {
        return texels(a) > texels(b);
    });
    return all;
}

}  // namespace lumel
