#include "atlas/lumels/sides.h"

#include <algorithm>
#include <utility>

namespace lumel {

std::vector<std::uint32_t> lumels_alike(const Lumels& from, const Lumels& to)
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(to);
    std::vector<std::uint32_t> alike;
    for (const Lumel& lumel : from.lumels)
        alike.push_back(by_side[place_by_side(lumel)]);
    return alike;
}

std::vector<char> buried_of(const Lumels& lumels)
{
    std::vector<char> buried;
    for (const Lumel& lumel : lumels.lumels)
        buried.push_back((lumel.flags & kLumelBuried) != 0);
    return buried;
}

Lumels with_buried(Lumels lumels, const std::vector<char>& buried)
{
    for (std::size_t i = 0; i < buried.size(); ++i) {
        std::uint32_t& flags = lumels.lumels[i].flags;
        flags = buried[i] ? flags | kLumelBuried : flags & ~kLumelBuried;
    }
    return lumels;
}

bool has_own_back(std::span<const glm::ivec2> back_shift, std::uint32_t chart)
{
    return chart < back_shift.size() && back_shift[chart] != glm::ivec2(0);
}

bool has_own_back(const Atlas& atlas, const Surface& surface)
{
    return std::any_of(surface.chart.begin(), surface.chart.end(),
                       [&](std::uint32_t chart) { return has_own_back(atlas.back_shift, chart); });
}

std::uint32_t map_texel(const Lumels& lumels, const Lumel& lumel)
{
    if (!is_back(lumel) || !has_own_back(lumels.back_shift, lumel.chart))
        return lumel.texel;
    const glm::ivec2 shift = lumels.back_shift[lumel.chart];
    return std::uint32_t(int(lumel.texel) + shift.y * lumels.width + shift.x);
}

std::uint32_t map_chart(const Lumels& lumels, const Lumel& lumel)
{
    const bool own = is_back(lumel) && has_own_back(lumels.back_shift, lumel.chart);
    return lumel.chart + (own ? std::uint32_t(lumels.back_shift.size()) : 0u);
}

Surface back_of(const Atlas& atlas, const Surface& surface)
{
    Surface back = surface;
    for (std::size_t t = 0; t < back.chart.size(); ++t) {
        std::swap(back.indices[3 * t + 1], back.indices[3 * t + 2]);
        if (!has_own_back(atlas.back_shift, surface.chart[t]))
            continue;
        // No vertex belongs to two charts.
        for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
            const std::uint32_t v = back.indices[corner];
            back.texcoord[v] = surface.texcoord[v] + glm::vec2(atlas.back_shift[surface.chart[t]]);
        }
        back.chart[t] += std::uint32_t(atlas.back_shift.size());
    }
    return back;
}

Surface own_back_of(const Atlas& atlas, const Surface& surface)
{
    Surface back = back_of(atlas, surface);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < surface.chart.size(); ++t) {
        if (!has_own_back(atlas.back_shift, surface.chart[t]))
            continue;
        std::copy_n(back.indices.begin() + std::ptrdiff_t(3 * t), 3,
                    back.indices.begin() + std::ptrdiff_t(3 * kept));
        back.chart[kept++] = back.chart[t];
    }
    back.indices.resize(3 * kept);
    back.chart.resize(kept);
    return back;
}

}  // namespace lumel
