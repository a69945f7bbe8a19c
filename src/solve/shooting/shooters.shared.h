#ifndef LUMEL_SOLVE_SHOOTING_SHOOTERS_SHARED_H
#define LUMEL_SOLVE_SHOOTING_SHOOTERS_SHARED_H
#include "raster/eyes/eye_views.shared.h"
#include "solve/shooting/power_pyramid.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kSelectGroup = 32u;

LUMEL_CONST uint kMaxBatch = 256u;  ///< K; 256 eyes fit the 16 KiB every uniform block holds

/// Energy of a shooter; its Eye has the geometry.
struct Shot {
    vec3 power;   ///< X_j A_j / (π p_j): a receiver multiplies it by V cosθ cosθ' / r²
    vec3 centre;  ///< centre of the lumel [m], world space; it decides near-field pairs
    float size;   ///< size of the lumel [m]
    float disc;   ///< A_j / π [m²] added to r² where there is no near field, else 0
    uint lumel;   ///< j
};

/// Push constants of shooters.select.comp.
struct SelectParams {
    PyramidLayout pyramid;
    uint count;           ///< K shooters
    uint emission_count;  ///< the first of these are drawn from the emission
    uint emission_index;  ///< next point of the emission's sequence
    uint source_index;    ///< next point of the source's sequence
    uint seed;            ///< differs between the halves of the solution
    uint random;          ///< 1: independent random numbers, as in the papers
    uint disc;            ///< 1: point-to-disc form factor
    uint centre;          ///< 1: shoot from the centroid
    uint merge;           ///< squares of 2^merge texels a side shoot as one; 0: no merging
    uint width;           ///< width of the atlas [texels]
    uint channels;        ///< 1: shooters take the colour channels in turn
};

LUMEL_SHARED_END
#endif
