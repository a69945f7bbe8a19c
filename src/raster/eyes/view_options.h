#pragma once
// Projection and resolution of the views from shooters.

#include <cstdint>

#include "raster/eyes/eye_views.shared.h"

namespace lumel {

enum class Projection : std::uint32_t {
    hemicube = kHemicube,      ///< five faces, each drawn for itself
    hemisphere = kHemisphere,  ///< one disc, drawn once with edges cut to their curves
};

/// Without defaults: each method has its own.
struct ViewOptions {
    Projection projection;
    int hemicube;  ///< side of the front face [pixels], see EyeViews
    int batch;     ///< K, eyes at a time
};

}  // namespace lumel
