#pragma once
// Options of a light transport matrix.

#include <cstdint>

#include "raster/eyes/view_options.h"

namespace lumel {

/// Without defaults: they are MatrixOptions'.
struct TransportOptions {
    ViewOptions views;
    std::uint32_t patches;  ///< n at most
    std::uint32_t bounces;  ///< k, reflections that count, 0: all
};

}  // namespace lumel
