#ifndef LUMEL_BUNDLES_BUNDLE_CASTER_GLSL
#define LUMEL_BUNDLES_BUNDLE_CASTER_GLSL

// Projection of points to bundle views.

#include "rays/device/bundle_caster.shared.h"

vec2 pixels_of(BundleView view, vec3 x)
{
    return (vec2(dot(view.right, x), dot(view.up, x)) - view.low) * view.scale;
}

#endif
