// Converts values per lumel to values per texel.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "atlas/finish/finish.h"
#include "atlas/lumels/sides.h"
#include "base/core/luminance.h"

namespace lumel {
namespace {

constexpr float kMinAlpha = 1.0f / 255.0f;

// Area-weighted mean square of the open lumels on one side of a chart: the front of a cushion, lit
// at its rim only, counts as brighter than faint, even light inside it.
struct SideLight {
    double squares = 0.0;
    double area = 0.0;
    bool present = false;

    void add(const Lumel& lumel, const glm::vec3& value)
    {
        present = true;
        if (lumel.flags & kLumelBuried)
            return;
        squares += luminance(value) * luminance(value) * double(lumel.area);
        area += lumel.area;
    }
    double mean() const { return area > 0.0 ? squares / area : 0.0; }
};

struct ChartSideLight {
    SideLight front, back;

    bool shows_back(bool prefers_front) const
    {
        return !front.present || (!prefers_front && back.mean() > front.mean());
    }
};

std::vector<ChartSideLight> chart_sides(const Lumels& lumels, std::span<const glm::vec3> values)
{
    std::uint32_t last_chart = 0;
    for (const Lumel& lumel : lumels.lumels)
        last_chart = std::max(last_chart, lumel.chart);
    std::vector<ChartSideLight> sides(std::size_t(last_chart) + 1);
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        ChartSideLight& chart = sides[lumel.chart];
        (is_back(lumel) ? chart.back : chart.front).add(lumel, values[i]);
    }
    return sides;
}

}  // namespace

std::vector<std::uint32_t> shown_lumels(const Lumels& lumels, std::span<const glm::vec3> light)
{
    const std::vector<ChartSideLight> sides = chart_sides(lumels, light);
    std::vector<std::uint32_t> shown(lumels.coverage.size(), kNoLumel);
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        if (has_own_back(lumels.back_shift, lumel.chart) ||
            is_back(lumel) == sides[lumel.chart].shows_back(lumels.shows_front))
            shown[map_texel(lumels, lumel)] = std::uint32_t(i);
    }
    return shown;
}

Image to_map(const Lumels& lumels, std::span<const glm::vec3> values)
{
    return to_map(lumels, shown_lumels(lumels, values), values);
}

Image to_map(const Lumels& lumels, std::span<const std::uint32_t> shown,
             std::span<const glm::vec3> values)
{
    Image map(lumels.width, lumels.height, 4);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown[i] == kNoLumel)
            continue;
        float* texel = map.values.data() + i * 4;
        for (int c = 0; c < 3; ++c)
            texel[c] = values[shown[i]][c];
        texel[3] = std::clamp(lumels.coverage[i], kMinAlpha, 1.0f);
    }
    return map;
}

}  // namespace lumel
