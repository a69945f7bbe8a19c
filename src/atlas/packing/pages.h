#pragma once
// Pages: where one texture cannot hold a map, it is written as several. Inside Lumel the map stays
// one square; pages are equal squares of it, row by row from the top left, and no chart lies on
// two of them.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"
#include "scene/gltf/extras.h"

namespace lumel {

struct Surface;

/// What the files of a map begin with.
inline constexpr const char* kLightmapName = "lightmap";

struct Pages {
    int count = 1;
    int side = 0;  ///< of a page [texels]

    /// Pages in a row of the map.
    int across() const;
    /// Side of the whole map [texels].
    int map_side() const { return across() * side; }
    /// Top left of a page in the map [texels].
    glm::ivec2 corner(int page) const;
    /// The page that a place of the map [texels] is on.
    int at(const glm::vec2& place) const;
};

/// The page of each vertex [V] of a surface: that of its chart, which no other has.
std::vector<std::uint16_t> pages_of_vertices(const Pages& pages, const Surface& surface);

/// The triangles on each page that a surface lies on, pages in order.
std::map<std::uint16_t, std::vector<std::uint32_t>> triangles_of_pages(const Pages& pages,
                                                                       const Surface& surface);

/// "lightmap", of several pages "lightmap-2".
std::string page_name(const Pages& pages, int page, const std::string& map);

/// A page of a map, or of a picture that has a whole number of pixels for each texel.
Image cut_page(const Pages& pages, int page, const Image& map);
/// Puts it back.
void paste_page(const Pages& pages, int page, const Image& part, Image& map);

/// What must lie on one page, and better on that of all others of its group.
struct Lot {
    std::uint32_t group = 0;
    double weight = 0.0;  ///< texels that it takes
};

/// Deals lots out. Each group goes to the first page that has room for it, the heaviest first. One
/// that no page has room for, where there are `most` or where it is larger than a page, is divided:
/// its lots fill, in order, the pages with most room. Returns the page of each lot; there are more
/// than `most` where even so some do not fit.
std::vector<int> deal_to_pages(const std::vector<Lot>& lots, double room, int most);

}  // namespace lumel
