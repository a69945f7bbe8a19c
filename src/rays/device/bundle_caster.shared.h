#ifndef LUMEL_RAYS_DEVICE_BUNDLE_CASTER_SHARED_H
#define LUMEL_RAYS_DEVICE_BUNDLE_CASTER_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kNoneListed = 0xffffffffu;  ///< end of a list, or no triangle

/// A parallel view of the scene, a square of pixels: x projects to ((right, up)·x - low) · scale.
struct BundleView {
    vec3 right;
    vec3 up;
    vec3 along;   ///< direction of the rays, unit
    vec2 low;     ///< [m]
    float scale;  ///< [pixels / m]
};

/// A triangle that touches a pixel.
struct Listed {
    uint triangle;
    uint next;  ///< next Listed of the pixel, or kNoneListed
};

struct BundleRay {
    vec3 origin;  ///< [m]
    float near;   ///< [m]
    float far;    ///< [m]
    uint view;
};

struct BundleHit {
    uint triangle;     ///< kNoneListed: none so far
    float distance;    ///< [m]
    vec2 barycentric;  ///< weights of its 2nd and 3rd vertex
};

/// Push constants of bundle_caster.vert and .frag. Views are stacked vertically in an image.
struct BundleDrawParams {
    uint view;
    uint slot;       ///< index in the image
    uint slots;      ///< number in the image
    uint side;       ///< view side [pixels]
    uint triangles;  ///< per view; further ones belong to the next views
    uint capacity;   ///< capacity of the lists
};

/// Push constants of bundle_caster.cast.comp.
struct BundleCastParams {
    uint first;       ///< first ray
    uint count;       ///< number of rays
    uint first_view;  ///< view in slot 0
    uint side;        ///< view side [pixels]
};

LUMEL_SHARED_END
#endif
