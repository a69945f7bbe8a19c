#version 460
#include "rays/device/bundle_caster.shared.h"
#include "rays/device/bundle_caster.glsl"

// Corners of the pixel box around a triangle: four vertices per triangle of a view, then those of
// the next views. The fragment stage discards pixels that the triangle does not touch.

layout(push_constant, scalar) uniform Params { BundleDrawParams p; };
layout(scalar) readonly buffer Views { BundleView views[]; };
layout(scalar) readonly buffer Positions { vec3 positions[]; };
layout(scalar) readonly buffer Corners { uint corners[]; };
layout(location = 0) flat out vec2 a;
layout(location = 1) flat out vec2 b;
layout(location = 2) flat out vec2 c;
layout(location = 3) flat out uint triangle;
layout(location = 4) flat out uint top;  // in the image [pixels]

// Maximum rounding error of rasterised positions [pixels].
const float kRounding = 1.0 / 64.0;

void main()
{
    const uint box = uint(gl_VertexIndex) / 4u, next = box / p.triangles;
    triangle = box - next * p.triangles;
    top = (p.slot + next) * p.side;
    const BundleView view = views[p.view + next];
    a = pixels_of(view, positions[corners[3u * triangle]]);
    b = pixels_of(view, positions[corners[3u * triangle + 1u]]);
    c = pixels_of(view, positions[corners[3u * triangle + 2u]]);
    const vec2 low = floor(min(a, min(b, c)) - kRounding);
    const vec2 high = floor(max(a, max(b, c)) + kRounding) + 1.0;
    const bvec2 is_high = bvec2((gl_VertexIndex & 1) != 0, (gl_VertexIndex & 2) != 0);
    const vec2 at = clamp(mix(low, high, is_high), 0.0, float(p.side));
    const vec2 size = vec2(p.side, p.side * p.slots);
    gl_Position = vec4(2.0 * (at + vec2(0, top)) / size - 1.0, 0.5, 1.0);
}
