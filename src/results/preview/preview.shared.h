#ifndef LUMEL_RESULTS_PREVIEW_PREVIEW_SHARED_H
#define LUMEL_RESULTS_PREVIEW_PREVIEW_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kBackIsBlack = 0u;    ///< back faces show no light
LUMEL_CONST uint kBackIsAlike = 1u;    ///< they show the light of the front
LUMEL_CONST uint kBackIsAnother = 2u;  ///< a face of its own shows it

/// A pixel of a picture is the mean of so many times so many.
LUMEL_CONST uint kSupersample = 2u;
LUMEL_CONST uint kShrinkGroup = 64u;

LUMEL_CONST uint kShowsLight = 0u;  ///< what surfaces send, L = ρ H / π + L_e
LUMEL_CONST uint kShowsMap = 1u;    ///< the map as it is

/// Push constants of preview.vert and preview.frag: one material.
struct PreviewParams {
    mat4 camera;      ///< world to clip space, reversed z
    vec4 base_color;  ///< linear, multiplies the texture
    vec3 emitted;     ///< [cd/m²], multiplies the texture
    float cutoff;     ///< transparent below; < 0: opaque
    uint back;        ///< kBackIsBlack, kBackIsAlike or kBackIsAnother
    uint shows;       ///< kShowsLight or kShowsMap
};

/// Push constants of preview.shrink.comp.
struct ShrinkParams {
    uint width, height;  ///< of the picture [pixels]
};

LUMEL_SHARED_END
#endif
