#ifndef LUMEL_METHODS_REDISTRIBUTION_CROSS_SHARED_H
#define LUMEL_METHODS_REDISTRIBUTION_CROSS_SHARED_H
#include "solve/transport/patch_shots.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kMaxBlock = 16u;   ///< maximum lumels per patch: the cells of its grid
LUMEL_CONST uint kBackLevels = 4u;  ///< mipmap levels of back hemicubes

struct BackPixel {
    vec3 shot;      ///< B^s of the surface seen [lm/m²]
    float inverse;  ///< 1 / distance [1/m], 0: no surface
};

/// Mipmaps of back hemicubes: all levels of one hemicube, then of the next.
struct BackLayout {
    uint side;          ///< side of the front face at level 0 [pixels]
    uint per_hemicube;  ///< pixels of all levels
};

/// Push constants of cross.resolve.comp: one level of all hemicubes.
struct ResolveParams {
    EyeViewLayout views;
    BackLayout back;
    uint level;
    uint batch;    ///< K
    uint samples;  ///< samples per pixel of the image
};

/// Push constants of cross.gather.comp.
struct CrossGatherParams {
    EyeViewLayout views;
    uint count;         ///< N lumels
    uint batch;         ///< K
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
};

/// Push constants of cross.receive.comp.
struct CrossReceiveParams {
    EyeViewLayout views;
    BackLayout back;
    DispatchRange range;  ///< lumels of this dispatch
    uint shots;           ///< K
    float near_radius;    ///< pairs closer than this × the larger size are in the near field
};

LUMEL_SHARED_END
#endif
