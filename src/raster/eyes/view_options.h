#pragma once
// Projection and resolution of views from shooters.

#include <cstdint>

#include "raster/eyes/eye_views.shared.h"

namespace lumel {

enum class Projection : std::uint32_t {
    hemicube = kHemicube,      ///< five faces, each rasterised separately
    hemisphere = kHemisphere,  ///< one disc, with edges subdivided to follow their curves
};

/// Without defaults: each method has its own.
struct ViewOptions {
    Projection projection;
    int hemicube;  ///< side of the front face [pixels], see EyeViews
    int batch;     ///< K, eyes per batch
};

}  // namespace lumel
