#ifndef LUMEL_SOLVE_GLOSSY_SHARED_H
#define LUMEL_SOLVE_GLOSSY_SHARED_H
#include "atlas/lumel.shared.h"
#include "solve/figures.shared.h"
#include "solve/power_pyramid.shared.h"
#include "visibility/eye_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kGlossySelectGroup = 32u;
LUMEL_CONST uint kGlossyReceiveGroup = 64u;
LUMEL_CONST uint kMostGlossyBatch = 128u;  ///< K; eyes and shots fit 16 KiB uniform blocks

LUMEL_CONST uint kMostLobes = 64u;  ///< that a shooter sends
/// Lobes of less shininess are wide: one of them says enough.
LUMEL_CONST float kNarrowLobe = 32.0f;

/// What a shooter sends: radiance × A_j / (p_j K), in a diffuse part and lobes.
struct GlossyShot {
    vec3 diffuse;     ///< the same in all directions
    vec3 centre;      ///< of the lumel [m], world
    float size;       ///< of the lumel [m]
    uint lobes;       ///< how many
    float shininess;  ///< of all of them
    float disc;       ///< A_j / π [m²] added to r² where needed, [BSS05] Eq. (8)
    uint lumel;       ///< j
};

/// A lobe of a shooter: specular × phong_lobe(toward, ω).
struct GlossyLobe {
    vec3 specular;
    vec3 toward;  ///< unit, to the earlier shooter whose light it reflects
};

/// Push constants of glossy.select.comp.
struct GlossySelectParams {
    PyramidLayout layout_;
    uint count;   ///< N
    uint shots;   ///< K
    uint before;  ///< K of the iteration before, 0: none
    uint index;   ///< shooters before this iteration
    uint seed;
    uint random;    ///< 1: independent random numbers
    uint channels;  ///< 1: shooters take the colour channels in turn
};

/// Push constants of glossy.receive.comp.
struct GlossyReceiveParams {
    EyeViewLayout views;
    uint first;  ///< lumels [first, last) of this dispatch
    uint last;
    uint count;  ///< N
    uint shots;  ///< K
    uint half_;  ///< 0 or 1: which half-solution takes this batch
    uint iteration;
    uint seed;
    uint centre;        ///< 1: receive at the centroid
    float near_radius;  ///< pairs closer than this × the larger size belong to the near field
    uint particles;     ///< 1: particles carry what lobes send on, 0: shooters
};

/// Push constants of glossy.evaluate.comp.
struct GlossyEvaluateParams {
    uint count;        ///< N
    float batches[2];  ///< in sums[h]
};

LUMEL_SHARED_END
#endif
