#pragma once
// Pages: the files of a map too large for one texture. Internally the map stays one square; pages
// are equal squares of it, in rows from the top left, and no chart lies on two of them.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"
#include "scene/gltf/extras.h"

namespace lumel {

struct Surface;

/// Prefix of a map's file names.
inline constexpr const char* kLightmapName = "lightmap";

struct Pages {
    int count = 1;
    int side = 0;  ///< page side [texels]

    /// Pages per row of the map.
    int across() const;
    /// Side of the whole map [texels].
    int map_side() const { return across() * side; }
    /// Top left of a page in the map [texels].
    glm::ivec2 corner(int page) const;
    /// The page of a map position [texels].
    int at(const glm::vec2& place) const;
};

/// The page of each vertex [V] of a surface, which is that of its chart.
std::vector<std::uint16_t> pages_of_vertices(const Pages& pages, const Surface& surface);

/// The triangles of a surface by page, pages in order.
std::map<std::uint16_t, std::vector<std::uint32_t>> triangles_of_pages(const Pages& pages,
                                                                       const Surface& surface);

/// "lightmap", or with several pages "lightmap-2".
std::string page_name(const Pages& pages, int page, const std::string& map);

/// Extracts a page of a map, or of an image with a whole number of pixels per texel.
Image cut_page(const Pages& pages, int page, const Image& map);
/// Inserts a page.
void paste_page(const Pages& pages, int page, const Image& part, Image& map);

/// Charts that must share a page, and preferably share it with the rest of their group.
struct Lot {
    std::uint32_t group = 0;
    double weight = 0.0;  ///< its texels
};

/// Assigns lots to pages by first fit, heaviest group first. A group that fits no page, because
/// there are `most` or it is larger than a page, is divided: its lots go, in order, to the page
/// with most space. Returns the page of each lot; more than `most` pages if some do not fit
/// otherwise.
std::vector<int> deal_to_pages(const std::vector<Lot>& lots, double room, int most);

}  // namespace lumel
