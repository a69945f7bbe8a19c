#ifndef LUMEL_SOLVE_GLOSSY_SHARED_H
#define LUMEL_SOLVE_GLOSSY_SHARED_H
#include "atlas/lumel.shared.h"
#include "solve/figures.shared.h"
#include "solve/power_pyramid.shared.h"
#include "visibility/hemicube.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kGlossySelectGroup = 32u;
LUMEL_CONST uint kGlossyReceiveGroup = 64u;
LUMEL_CONST uint kMostGlossyBatch = 128u;  ///< K; eyes and shots fit 16 KiB uniform blocks

/// What a shooter sends: radiance × A_j / (p_j K), in a diffuse part and a lobe.
struct GlossyShot {
    vec3 diffuse;     ///< the same in all directions
    vec3 specular;    ///< × phong_lobe(toward, ω)
    vec3 toward;      ///< unit, to the earlier shooter whose light the lobe reflects
    vec3 centre;      ///< of the lumel [m], world
    float size;       ///< of the lumel [m]
    float shininess;  ///< of the lobe
    float disc;       ///< A_j / π [m²] added to r² where needed, [BSS05] Eq. (8)
    uint lumel;       ///< j
};

/// Push constants of glossy.select.comp.
struct GlossySelectParams {
    PyramidLayout layout_;
    uint count;   ///< N
    uint shots;   ///< K
    uint before;  ///< K of the iteration before, 0: none
    uint index;   ///< shooters before this iteration
    uint seed;
    uint random;  ///< 1: independent random numbers
};

/// Push constants of glossy.receive.comp.
struct GlossyReceiveParams {
    HemicubeLayout hemicubes;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint count;  ///< N
    uint shots;  ///< K
    uint half_;  ///< 0 or 1: which half-solution takes this batch
    uint iteration;
    uint seed;
    uint centre;        ///< 1: receive at the centroid
    float near_radius;  ///< pairs closer than this × the larger size belong to the near field
};

/// Push constants of glossy.evaluate.comp.
struct GlossyEvaluateParams {
    uint count;        ///< N
    float batches[2];  ///< in sums[h]
};

LUMEL_SHARED_END
#endif
