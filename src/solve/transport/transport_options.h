#pragma once
// Options of a light transport matrix.

#include <cstdint>

#include "raster/eyes/view_options.h"

namespace lumel {

/// Without defaults: they are MatrixOptions'.
struct TransportOptions {
    ViewOptions views;
    std::uint32_t patches;  ///< maximum n
    std::uint32_t bounces;  ///< reflections k, 0: all
};

}  // namespace lumel
