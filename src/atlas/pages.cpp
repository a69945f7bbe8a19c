#include "atlas/pages.h"

#include <algorithm>
#include <numeric>

#include "atlas/atlas.h"

namespace lumel {

int Pages::across() const
{
    int across = 1;
    while (across * across < count)
        ++across;
    return across;
}

glm::ivec2 Pages::corner(int page) const
{
    return side * glm::ivec2(page % across(), page / across());
}

int Pages::at(const glm::vec2& place) const
{
    const glm::ivec2 cell = glm::clamp(glm::ivec2(place) / std::max(side, 1), 0, across() - 1);
    return cell.y * across() + cell.x;
}

int page_of(const Pages& pages, const Surface& surface)
{
    if (pages.count == 1 || surface.indices.size() < 3)
        return 0;
    const auto& place = surface.texcoord;
    const auto& corner = surface.indices;
    return pages.at((place[corner[0]] + place[corner[1]] + place[corner[2]]) / 3.0f);
}

std::string page_name(const Pages& pages, int page, const std::string& map)
{
    return pages.count == 1 ? map : map + "-" + std::to_string(page);
}

Image cut_page(const Pages& pages, int page, const Image& map)
{
    if (pages.count == 1)
        return map;
    const int scale = map.width / pages.map_side(), side = pages.side * scale;
    const glm::ivec2 corner = pages.corner(page) * scale;
    Image part(side, side, map.channels);
    for (int y = 0; y < side; ++y)
        std::copy_n(map.at(corner.x, corner.y + y), std::size_t(side) * std::size_t(map.channels),
                    part.at(0, y));
    return part;
}

void paste_page(const Pages& pages, int page, const Image& part, Image& map)
{
    const glm::ivec2 corner = pages.corner(page);
    for (int y = 0; y < part.height; ++y)
        std::copy_n(part.at(0, y), std::size_t(part.width) * std::size_t(part.channels),
                    map.at(corner.x, corner.y + y));
}

std::vector<int> deal_to_pages(const std::vector<double>& weights, double room)
{
    std::vector<std::size_t> order(weights.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
    std::vector<double> left;
    std::vector<int> page(weights.size());
    for (const std::size_t i : order) {
        const auto fits = [&](double rest) { return rest >= weights[i]; };
        const auto found = std::find_if(left.begin(), left.end(), fits);
        page[i] = int(found - left.begin());
        if (found == left.end())
            left.push_back(room);
        left[std::size_t(page[i])] -= weights[i];
    }
    return page;
}

}  // namespace lumel
