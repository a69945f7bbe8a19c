#ifndef LUMEL_BASE_IMAGES_TONE_CURVE_SHARED_H
#define LUMEL_BASE_IMAGES_TONE_CURVE_SHARED_H
#include "base/core/shared.h"

// AgX: from linear light to display codes, keeping highlights and hues [Sob22]. Formulas with the
// sigmoid's polynomial [Wre23], as in three.js (AgXToneMapping), Filament and Blender:
//
//     v = M_in x                              Rec. 709 to Rec. 2020, then towards grey
//     t = (log2 v − e_0) / (e_1 − e_0)        in 0…1: 10 stops below 0.18 to 6.5 above
//     s = polynomial of t                     sigmoid
//     y = M_709 (M_out s)^2.2                 linear Rec. 709
//     code = sRGB curve of y                  IEC 61966-2-1
//
// Mixing with grey before the curve lets saturated light fade to white instead of clipping in one
// channel. 0.18 becomes code 0.5, 1 becomes 0.79, and 16 is white.

LUMEL_SHARED_BEGIN

LUMEL_CONST float kDarkestStop = -12.47393f;  ///< e_0 [log2]
LUMEL_CONST float kWhiteStop = 4.026069f;     ///< e_1 [log2]

// GLSL has no references. NOLINTBEGIN(performance-unnecessary-value-param)

/// sRGB curve: linear 0…1 to code 0…1. Fitted by roots, within 0.02 of 255.
LUMEL_FUNCTION vec3 srgb_from_linear(vec3 linear)
{
    const vec3 half_power = sqrt(linear), quarter = sqrt(half_power), eighth = sqrt(quarter);
    return mix(0.64238316f * half_power + 0.71209014f * quarter - 0.33686143f * eighth -
                   0.01756893f * linear,
               12.92f * linear, lessThanEqual(linear, vec3(0.0031308f)));
}

/// Display codes 0…1 of exposed light, linear Rec. 709.
LUMEL_FUNCTION vec3 tone_curve(vec3 exposed)
{
    // Columns.
    const mat3 to_log = mat3(0.544823657f, 0.140441920f, 0.088839052f, 0.373770327f, 0.754144186f,
                             0.178897860f, 0.081359669f, 0.105410391f, 0.732327437f);
    const mat3 from_log =
        mat3(1.127100582f, -0.141329763f, -0.141329763f, -0.110606643f, 1.157823702f, -0.110606643f,
             -0.016493939f, -0.016493939f, 1.251936407f);
    const mat3 to_rec709 =
        mat3(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f, -0.0728f, -0.0083f, 1.1187f);

    const vec3 stops = log2(max(to_log * exposed, vec3(1e-10f)));
    const vec3 t = clamp((stops - kDarkestStop) / (kWhiteStop - kDarkestStop), 0.0f, 1.0f);
    const vec3 sigmoid =
        (((((15.5f * t - 40.14f) * t + 31.96f) * t - 6.868f) * t + 0.4298f) * t + 0.1191f) * t -
        0.00232f;
    const vec3 u = max(from_log * sigmoid, vec3(0.0f));
    const vec3 powered =
        ((((0.25679179f * u - 0.68657716f) * u + 0.82929690f) * u + 0.60612392f) * u -
         0.00475681f) *
        u;  // u^2.2, fitted within 0.1 of 255 in the code
    return srgb_from_linear(clamp(to_rec709 * powered, 0.0f, 1.0f));
}

// NOLINTEND(performance-unnecessary-value-param)

LUMEL_SHARED_END
#endif
