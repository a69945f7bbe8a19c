#ifndef LUMEL_METHODS_GATHER_GATHER_SHARED_H
#define LUMEL_METHODS_GATHER_GATHER_SHARED_H
#include "raster/eyes/eye_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kIntegrateGroup = 256u;  ///< group of gather.integrate.comp; a power of two
LUMEL_CONST uint kMaxHemicubes = 1024u;   ///< maximum K

/// Position of a hemicube's eye on a lumel. Light from behind the geometric surface is excluded
/// where the eye's normal differs from it.
struct GatheringPoint {
    vec3 facing;  ///< geometric normal in the eye's frame (t, b, n), any length
    uint tilted;  ///< 1: it is not the eye's normal
};

/// Push constants of gather.eyes.comp.
struct GatherEyesParams {
    uint first;     ///< first lumel in the order of gathering
    uint eyes;      ///< hemicubes in this batch
    uint channels;  ///< hemicubes per lumel: 1, or one per colour channel
    uint point;     ///< index in each lumel's sequence of receiving points
    uint seed;
    uint centre;       ///< 1: receive at the centroid
    float ray_offset;  ///< distance of eyes from their surface [m]
};

/// Push constants of gather.integrate.comp.
struct IntegrateParams {
    EyeViewLayout views;
    uint samples;  ///< samples per pixel
};

/// Push constants of gather.multiply.comp.
struct MultiplyParams {
    EyeViewLayout views;
    uint samples;  ///< samples per pixel
    uint side;     ///< of level 0 of the mipmaps [pixels], a power of two
    uint eyes;     ///< K
};

/// Push constants of gather.reduce.comp: one level of all mipmaps.
struct ReduceParams {
    uint side;    ///< of the level written [pixels]
    uint from;    ///< first pixel of the level read
    uint to;      ///< first pixel of the level written
    uint eyes;    ///< K
    float whole;  ///< pixels of level 0: the last level is the mean of as many
};

/// Push constants of gather.bounce.comp.
struct BounceParams {
    uint first;       ///< first lumel of the order
    uint lumels;      ///< lumels in this batch
    uint channels;    ///< hemicubes per lumel
    uint count;       ///< N
    uint averaged;    ///< 1: arriving light is added to the half-solution
    uint half_index;  ///< 0 or 1
    uvec2 taken;      ///< bounces in each half-solution, including this one
};

/// Push constants of gather.sums.comp.
struct BounceFiguresParams {
    uint count;   ///< N
    uvec2 taken;  ///< bounces in each half-solution
};

LUMEL_SHARED_END
#endif
