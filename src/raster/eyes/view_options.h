#pragma once
// Resolution of shooters' views.

#include "raster/eyes/eye_views.h"

namespace lumel {

struct ViewOptions {
    Projection projection = Projection::hemicube;
    int hemicube = 256;  ///< side of the front face [pixels], see EyeViews
    int batch = 16;      ///< K, eyes per batch
};

}  // namespace lumel
