#pragma once
// Pages: where one texture cannot hold a map, it is written as several. Inside Lumel the map stays
// one square; pages are equal squares of it, row by row from the top left, and no surface lies on
// two of them.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/image.h"

namespace lumel {

struct Surface;

inline constexpr int kMostPages = 256;
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

/// The page that holds a surface.
int page_of(const Pages& pages, const Surface& surface);

/// "lightmap", of several pages "lightmap-2".
std::string page_name(const Pages& pages, int page, const std::string& map);

/// A page of a map, or of a picture that has a whole number of pixels for each texel.
Image cut_page(const Pages& pages, int page, const Image& map);
/// Puts it back.
void paste_page(const Pages& pages, int page, const Image& part, Image& map);

/// Deals out what must stay together. weights: texels that each takes. Each goes to the first page
/// that has room for it, the heaviest first. Returns the page of each; as many as are needed.
std::vector<int> deal_to_pages(const std::vector<double>& weights, double room);

}  // namespace lumel
