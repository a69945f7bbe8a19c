#include "atlas/packing/pages.h"

#include <algorithm>
#include <utility>

#include "atlas/packing/atlas.h"

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

std::vector<std::uint16_t> pages_of_vertices(const Pages& pages, const Surface& surface)
{
    std::vector<std::uint16_t> page(surface.texcoord.size(), 0);
    for (const auto& [number, triangles] : triangles_of_pages(pages, surface))
        for (const std::uint32_t triangle : triangles)
            for (std::size_t corner = 3 * triangle; corner < 3 * std::size_t(triangle) + 3;
                 ++corner)
                page[surface.indices[corner]] = number;
    return page;
}

std::map<std::uint16_t, std::vector<std::uint32_t>> triangles_of_pages(const Pages& pages,
                                                                       const Surface& surface)
{
    std::map<std::uint16_t, std::vector<std::uint32_t>> triangles;
    const auto& place = surface.texcoord;
    for (std::uint32_t t = 0; t < surface.indices.size() / 3; ++t) {
        const std::uint32_t* corner = &surface.indices[3 * std::size_t(t)];
        const glm::vec2 middle = (place[corner[0]] + place[corner[1]] + place[corner[2]]) / 3.0f;
        triangles[std::uint16_t(pages.count > 1 ? pages.at(middle) : 0)].push_back(t);
    }
    return triangles;
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

namespace {

/// Lots of a group, as indices.
struct Group {
    std::vector<std::size_t> lots;
    double weight = 0.0;
};

std::vector<Group> groups_of(const std::vector<Lot>& lots)
{
    std::vector<Group> groups;
    for (std::size_t i = 0; i < lots.size(); ++i) {
        groups.resize(std::max(groups.size(), std::size_t(lots[i].group) + 1));
        groups[lots[i].group].lots.push_back(i);
        groups[lots[i].group].weight += lots[i].weight;
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.weight > b.weight; });
    return groups;
}

/// Pages during the assignment.
class Dealing {
public:
    Dealing(const std::vector<Lot>& lots, double room, int most)
        : lots_(lots),
          room_(room),
          most_(std::size_t(most)),
          page_(lots.size())
    {
    }

    void deal(const Group& group)
    {
        const std::size_t first = first_with(group.weight);
        const bool whole = first < left_.size() || (left_.size() < most_ && group.weight <= room_);
        std::size_t page = first;
        for (const std::size_t lot : group.lots) {
            const double weight = lots_[lot].weight;
            if (!whole && (page >= left_.size() || left_[page] < weight))
                page = emptiest(weight);
            put(lot, page);
        }
    }

    std::vector<int> pages() && { return std::move(page_); }

private:
    std::size_t first_with(double weight) const
    {
        return std::size_t(
            std::find_if(left_.begin(), left_.end(), [&](double left) { return left >= weight; }) -
            left_.begin());
    }
    /// The page with the most space, if sufficient, else a new one.
    std::size_t emptiest(double weight) const
    {
        const auto most = std::max_element(left_.begin(), left_.end());
        if (left_.size() < most_ || most == left_.end() || *most < weight)
            return left_.size();
        return std::size_t(most - left_.begin());
    }
    void put(std::size_t lot, std::size_t page)
    {
        if (page == left_.size())
            left_.push_back(room_);
        left_[page] -= lots_[lot].weight;
        page_[lot] = int(page);
    }

    const std::vector<Lot>& lots_;
    double room_;
    std::size_t most_;
    std::vector<double> left_;  ///< [pages]
    std::vector<int> page_;     ///< [lots]
};

}  // namespace

std::vector<int> deal_to_pages(const std::vector<Lot>& lots, double room, int most)
{
    Dealing dealing(lots, room, most);
    for (const Group& group : groups_of(lots))
        dealing.deal(group);
    return std::move(dealing).pages();
}

}  // namespace lumel
