#version 460
#include "rays/device/bundle_caster.shared.h"

// Prepends a triangle to the list of each pixel that it touches.

layout(push_constant, scalar) uniform Params { BundleDrawParams p; };
layout(scalar) buffer Heads { uint heads[]; };  // [slots][side][side]
layout(scalar) writeonly buffer Lists { Listed lists[]; };
layout(scalar) buffer Used { uint used; };
layout(location = 0) flat in vec2 a;
layout(location = 1) flat in vec2 b;
layout(location = 2) flat in vec2 c;
layout(location = 3) flat in uint triangle;
layout(location = 4) flat in uint top;  // in the image [pixels]

// Half a pixel plus the maximum rounding error [pixels].
const float kReach = 0.5 + 1.0 / 64.0;

// True if a line along an edge of the triangle separates it from the pixel.
bool parted(vec2 edge, vec2 centre)
{
    const vec2 across = vec2(edge.y, -edge.x);
    const vec3 at = vec3(dot(across, a - centre), dot(across, b - centre), dot(across, c - centre));
    const float reach = kReach * (abs(across.x) + abs(across.y));
    return min(at.x, min(at.y, at.z)) > reach || max(at.x, max(at.y, at.z)) < -reach;
}

void main()
{
    const vec2 centre = gl_FragCoord.xy - vec2(0, top);
    if (parted(b - a, centre) || parted(c - b, centre) || parted(a - c, centre))
        discard;
    const uint index = atomicAdd(used, 1u);
    if (index >= p.capacity)
        return;
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    lists[index] = Listed(triangle, atomicExchange(heads[pixel.y * p.side + pixel.x], index));
}
