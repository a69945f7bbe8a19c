#ifndef LUMEL_RASTER_SHADOW_MAPS_LAMPS_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_LAMPS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
#include "raster/shadow_maps/light_sums.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kNoProfile = 0xffffffffu;

/// A point or spot light.
struct Lamp {
    vec3 position;       ///< [m]
    float radius;        ///< [m], 0: a point
    vec3 x, y, z;        ///< unit axes in the world; its light is centred on -z
    vec3 intensity;      ///< [cd]; with a profile, a factor
    float range;         ///< [m], 0: unlimited
    float cone_scale;    ///< KHR_lights_punctual's lightAngleScale and lightAngleOffset;
    float cone_offset;   ///< 0 and 1: no cone
    uint profile;        ///< index into the profiles, or kNoProfile
    uint eyes_per_look;  ///< eyes that together cover all directions and channels
    float share;         ///< share of the lamp's light per group of eyes
};

LUMEL_CONST uint kOpenPoints = 4u;  ///< points of a lumel for unoccluded light

/// Push constants of lamps.receive.comp.
struct LampReceiveParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint lamp;
    uint first_eye;  ///< index of the batch's first eye
    uint eyes;       ///< K
    uint seed;
    uint centre;  ///< 1: receive at the centroid
};

LUMEL_SHARED_END
#endif
