#pragma once
// Storage of overlapping surfaces in illumination maps.

#include <cstdint>

#include "raster/parallel/illumination_maps.shared.h"

namespace lumel {

enum class Layers : std::uint32_t {
    stochastic = kStochasticLayers,  ///< [TN11] section 3: one random surface per pixel
    list = kListedLayers,            ///< all surfaces, in a list per pixel
    peel = kPeeledLayers,            ///< all surfaces, one per pixel and pass
};

}  // namespace lumel
