#ifndef LUMEL_RASTER_EYES_PROBE_SHARED_H
#define LUMEL_RASTER_EYES_PROBE_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

/// A surface point to test, world space.
struct Question {
    vec3 position;  ///< [m]
    vec3 facing;    ///< geometric normal, any length
};

/// Push constants of probe.comp.
struct ProbeParams {
    EyeViewLayout views;
    uint eye;
    uint count;
};

LUMEL_SHARED_END
#endif
