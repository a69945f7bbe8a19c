#ifndef LUMEL_RASTER_EYES_LIT_VIEWS_SHARED_H
#define LUMEL_RASTER_EYES_LIT_VIEWS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of the shaders that render lit views.
struct LitParams {
    uint eye;    ///< index into the eyes
    uint face;   ///< hemicube face, 0…4
    float near;  ///< [m]
    uint width;  ///< atlas size [texels]
    uint height;
    Passage passage;  ///< for cut-outs
};

LUMEL_SHARED_END
#endif
