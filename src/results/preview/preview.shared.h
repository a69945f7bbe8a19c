#ifndef LUMEL_RESULTS_PREVIEW_PREVIEW_SHARED_H
#define LUMEL_RESULTS_PREVIEW_PREVIEW_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kBackIsBlack = 0u;    ///< back faces show no light
LUMEL_CONST uint kBackIsAlike = 1u;    ///< back faces show the light of the front
LUMEL_CONST uint kBackIsAnother = 2u;  ///< a separate face shows it

/// A pixel of the image is the mean of the covered ones of kSupersample × kSupersample samples.
LUMEL_CONST uint kSupersample = 2u;

LUMEL_CONST uint kShowsLight = 0u;  ///< light from surfaces, L = ρ H / π + L_e
LUMEL_CONST uint kShowsMap = 1u;    ///< the map as it is
LUMEL_CONST uint kShowsFilm = 2u;  ///< kShowsLight × opacity; where opacity < PreviewParams::solid
LUMEL_CONST uint kShowsTint = 3u;  ///< tint of glass; where opacity < PreviewParams::solid

/// Push constants of preview.vert and preview.frag: one material.
struct PreviewParams {
    mat4 camera;         ///< world to clip space, reversed z
    vec4 base_color;     ///< linear, multiplies the texture
    vec3 emitted;        ///< [cd/m²], multiplies the texture
    float cutoff;        ///< covered where alpha ≥ cutoff; < 0: coverage is alpha
    float transmission;  ///< share of glass in the covered area
    float solid;         ///< least opacity of what hides all behind it
    uint back;           ///< kBackIsBlack, kBackIsAlike or kBackIsAnother
    uint shows;          ///< kShows…
};

/// Push constants of preview.shrink.comp.
struct ShrinkParams {
    uint width, height;  ///< size of the image [pixels]
    float exposure;      ///< of display codes; 0: radiance
};

LUMEL_SHARED_END
#endif
