#ifndef LUMEL_METHODS_GLOSSY_LOBES_SHARED_H
#define LUMEL_METHODS_GLOSSY_LOBES_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kMaxGlossyBatch = 128u;  ///< K; eyes and shots fit 16 KiB uniform blocks

LUMEL_CONST uint kMaxLobes = 64u;  ///< per shooter
/// Lobes of less shininess are wide: one of them represents all.
LUMEL_CONST float kNarrowLobe = 32.0f;

/// Light of a shooter: radiance × A_j / (p_j K), as a diffuse part and lobes.
struct GlossyShot {
    vec3 diffuse;     ///< equal in all directions
    vec3 centre;      ///< centre of the lumel [m], world space
    float size;       ///< size of the lumel [m]
    uint lobes;       ///< number of lobes
    float shininess;  ///< shininess of all of them
    float disc;       ///< A_j / π [m²] added to r² where needed, [BSS05] Eq. (8)
    uint lumel;       ///< j
};

/// A lobe of a shooter: specular × phong_lobe(toward, ω).
struct GlossyLobe {
    vec3 specular;
    vec3 toward;  ///< unit, to the earlier shooter whose light it reflects
};

LUMEL_SHARED_END
#endif
