#ifndef LUMEL_METHODS_GLOSSY_GLOSSY_SHARED_H
#define LUMEL_METHODS_GLOSSY_GLOSSY_SHARED_H
#include "atlas/packing/lumel.shared.h"
#include "methods/glossy/lobes.shared.h"
#include "raster/eyes/eye_views.shared.h"
#include "solve/shooting/lumel_sums.shared.h"
#include "solve/shooting/power_pyramid.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kGlossySelectGroup = 32u;

/// Push constants of glossy.select.comp.
struct GlossySelectParams {
    PyramidLayout pyramid;
    uint count;   ///< N
    uint shots;   ///< K
    uint before;  ///< K of the previous iteration, 0: none
    uint index;   ///< shooters before this iteration
    uint seed;
    uint random;       ///< 1: independent random numbers
    uint channels;     ///< 1: shooters take the colour channels in turn
    uint centre;       ///< 1: shooters are at the centres of squares
    uint merge;        ///< squares have 2^merge texels a side, with `centre`
    uint width;        ///< width of the atlas [texels]
    uint area_shots;   ///< the first of them are drawn by area alone
    float area_share;  ///< mean fraction drawn by area
};

/// Push constants of glossy.receive.comp.
struct GlossyReceiveParams {
    EyeViewLayout views;
    DispatchRange range;  ///< lumels of this dispatch
    uint count;           ///< N
    uint shots;           ///< K
    uint half_index;      ///< 0 or 1: which half-solution takes this batch
    uint iteration;
    uint seed;
    uint centre;        ///< 1: receive at the centroid
    float near_radius;  ///< pairs closer than this × the larger size are in the near field
    uint particles;     ///< 1: particles carry the light of lobes, 0: shooters
};

/// Push constants of glossy.evaluate.comp.
struct GlossyEvaluateParams {
    uint count;        ///< N
    float batches[2];  ///< iterations in sums[h]
};

LUMEL_SHARED_END
#endif
