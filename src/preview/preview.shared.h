#ifndef LUMEL_PREVIEW_PREVIEW_SHARED_H
#define LUMEL_PREVIEW_PREVIEW_SHARED_H
#include "core/shared.h"
LUMEL_SHARED_BEGIN

/// Push constants of preview.vert and preview.frag: one material.
struct PreviewParams {
    mat4 camera;        ///< world to clip space, reversed z
    vec4 base_color;    ///< linear, multiplies the texture
    vec3 emitted;       ///< [cd/m²], multiplies the texture
    float cutoff;       ///< transparent below; < 0: opaque
    uint double_sided;  ///< 1: back faces are seen
};

LUMEL_SHARED_END
#endif
