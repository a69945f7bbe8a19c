#ifndef LUMEL_RASTER_SHADOW_MAPS_LAMPS_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_LAMPS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
#include "raster/shadow_maps/light_sums.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kLampGroup = 64u;  ///< threads per workgroup of lamps.receive.comp

LUMEL_CONST uint kNoProfile = 0xffffffffu;

/// A point or spot light.
struct Lamp {
    vec3 position;       ///< [m]
    float radius;        ///< [m], 0: a point
    vec3 x, y, z;        ///< its unit axes in the world; it shines along -z
    vec3 intensity;      ///< [cd]; a factor where there is a profile
    float range;         ///< [m], 0: unlimited
    float cone_scale;    ///< KHR_lights_punctual's lightAngleScale and lightAngleOffset;
    float cone_offset;   ///< 0 and 1: no cone
    uint profile;        ///< index into the profiles, or kNoProfile
    uint eyes_per_look;  ///< that together see all around and in all channels
    float share;         ///< of the lamp's light that a look stands for
};

LUMEL_CONST uint kOpenPoints = 4u;  ///< of a lumel at which unoccluded light is taken

/// Push constants of lamps.receive.comp.
struct LampReceiveParams {
    EyeViewLayout views;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint lamp;
    uint first_eye;  ///< of this batch among the lamp's
    uint eyes;       ///< K
    uint seed;
    uint centre;  ///< 1: receive at the centroid
};

LUMEL_SHARED_END
#endif
