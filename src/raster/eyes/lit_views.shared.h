#ifndef LUMEL_RASTER_EYES_LIT_VIEWS_SHARED_H
#define LUMEL_RASTER_EYES_LIT_VIEWS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of the shaders that draw lit views.
struct LitParams {
    uint eye;    ///< index into the eyes
    uint face;   ///< of its hemicube, 0…4
    float near;  ///< [m]
    uint width;  ///< of the atlas [texels]
    uint height;
    Passage passage;  ///< of cut-outs
};

LUMEL_SHARED_END
#endif
