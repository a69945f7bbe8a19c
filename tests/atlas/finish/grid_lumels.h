#pragma once
// Lumels of a small map, texel by texel.

#include <cstdint>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel::test {

/// One front lumel of area 1 for every letter of the rows; the letter is its chart, '.' is empty,
/// a capital letter is a buried lumel of the chart of that name.
inline Lumels grid(const std::vector<std::string>& rows)
{
    Lumels lumels;
    lumels.width = int(rows[0].size());
    lumels.height = int(rows.size());
    for (const std::string& row : rows)
        for (const char letter : row) {
            lumels.coverage.push_back(letter == '.' ? 0.0f : 1.0f);
            if (letter == '.')
                continue;
            Lumel lumel{};
            lumel.area = 1.0f;
            lumel.texel = std::uint32_t(lumels.coverage.size() - 1);
            const bool is_buried = letter >= 'A' && letter <= 'Z';
            lumel.chart = std::uint32_t(letter - (is_buried ? 'A' : 'a'));
            lumel.flags = is_buried ? kLumelBuried : 0;
            lumels.lumels.push_back(lumel);
        }
    return lumels;
}

inline glm::vec3 rgb(const Image& map, int x, int y)
{
    return {map.at(x, y)[0], map.at(x, y)[1], map.at(x, y)[2]};
}

}  // namespace lumel::test
