#pragma once
// Storage of overlapping surfaces in illumination maps.

#include <cstdint>

#include "raster/parallel/illumination_maps.shared.h"

namespace lumel {

enum class Layers : std::uint32_t {
    stochastic = kStochasticLayers,  ///< [TN11] section 3: one surface a pixel, by chance
    list = kListedLayers,            ///< every surface, in a list for each pixel
    peel = kPeeledLayers,            ///< every surface, one a pixel in each of several passes
};

}  // namespace lumel
