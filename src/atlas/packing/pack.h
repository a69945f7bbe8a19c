#pragma once
// Rectangles into a square.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"
#include "atlas/packing/density.h"

namespace lumel {

/// Side of the map where no option sets it: detail for a room, seconds to minutes on a small
/// machine. It is doubled while charts do not fit well.
constexpr int kDefaultSide = 512;

/// What is to be placed.
struct Rectangle {
    glm::dvec2 size{0.0};  ///< [m]
    Density density;
    std::uint32_t group = 0;  ///< rectangles of one group are on one page where they fit
    std::uint32_t lot = 0;    ///< those of one lot always are
};

struct PackedRectangle {
    glm::ivec2 corner{0};  ///< top left [texels]
    glm::ivec2 size{1};    ///< whole texels, at least 1
};

struct Packing {
    Pages pages;
    double density = 0.0;  ///< of rectangles whose own is neither fixed nor lowered [texels/m]
    std::vector<PackedRectangle> rectangles;
};

/// Places rectangles with `options.gutter` empty texels between any two, and half as many along
/// the rim of each page. More than one page is used where the density that is asked for needs it,
/// or to fill maps of `options.size` where none is asked for. Each size is rounded to whole texels.
/// Adds to `notes` where the requested density was not possible. Throws Error{input} if they cannot
/// be made to fit.
Packing pack(const std::vector<Rectangle>& rectangles, const AtlasOptions& options,
             std::vector<std::string>& notes);

}  // namespace lumel
