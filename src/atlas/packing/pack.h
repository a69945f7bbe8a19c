#pragma once
// Packs rectangles into squares.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"
#include "atlas/packing/density.h"

namespace lumel {

/// Default side of the map: detail for a room, seconds to minutes on a small machine. It is doubled
/// while charts do not fit well.
constexpr int kDefaultSide = 512;

/// A rectangle to place.
struct Rectangle {
    glm::dvec2 size{0.0};  ///< [m]
    Density density;
    std::uint32_t group = 0;  ///< rectangles of a group share a page if possible
    std::uint32_t lot = 0;    ///< rectangles of a lot always share a page
};

struct PackedRectangle {
    glm::ivec2 corner{0};  ///< top left [texels]
    glm::ivec2 size{1};    ///< whole texels, at least 1
};

struct Packing {
    Pages pages;
    double density = 0.0;  ///< common density of rectangles [texels/m]
    std::vector<PackedRectangle> rectangles;
};

/// Places rectangles with `options.gutter` empty texels between any two, and half as many along the
/// border of each page. Uses several pages if the requested density needs them, or to fill maps of
/// `options.size` if no density is requested. Sizes are rounded to whole texels. Adds to `notes` if
/// the requested density is not possible. Throws Error{input} if they cannot fit.
Packing pack(const std::vector<Rectangle>& rectangles, const AtlasOptions& options,
             std::vector<std::string>& notes);

}  // namespace lumel
