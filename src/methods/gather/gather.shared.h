#ifndef LUMEL_METHODS_GATHER_GATHER_SHARED_H
#define LUMEL_METHODS_GATHER_GATHER_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kBounceGroup = 64u;  ///< threads per workgroup of gather.eyes and gather.bounce
LUMEL_CONST uint kIntegrateGroup = 256u;  ///< of gather.integrate.comp; a power of two
LUMEL_CONST uint kMaxHemicubes = 1024u;   ///< K at most

/// A hemicube's eye stands at a point of a lumel. What lies behind the surface there, which matters
/// if that is not where the eye looks, is no light for it.
struct GatheringPoint {
    vec3 facing;  ///< geometric normal in the eye's frame (t, b, n), any length
    uint tilted;  ///< 1: it is not the eye's normal
};

/// Push constants of gather.eyes.comp.
struct GatherEyesParams {
    uint first;     ///< of the order in which lumels gather
    uint eyes;      ///< of this batch
    uint channels;  ///< hemicubes of one lumel: one, or one for each colour channel
    uint point;     ///< of the sequence of points of each lumel that receive
    uint seed;
    uint centre;       ///< 1: receive at the centroid
    float ray_offset;  ///< of eyes above their surface [m]
};

/// Push constants of gather.integrate.comp.
struct IntegrateParams {
    EyeViewLayout views;
    uint samples;  ///< of each pixel
};

/// Push constants of gather.bounce.comp.
struct BounceParams {
    uint first;       ///< of the order
    uint lumels;      ///< of this batch
    uint channels;    ///< hemicubes of one lumel
    uint count;       ///< N
    uint averaged;    ///< 1: what arrives is added to the half-solution
    uint half_index;  ///< 0 or 1
    uvec2 taken;      ///< bounces in each half-solution, with this one
};

/// Push constants of gather.figures.comp.
struct BounceFiguresParams {
    uint count;   ///< N
    uvec2 taken;  ///< bounces in each half-solution
};

LUMEL_SHARED_END
#endif
