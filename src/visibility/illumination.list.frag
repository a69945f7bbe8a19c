#version 460
#include "visibility/illumination_maps.shared.h"
#include "visibility/illumination.glsl"

// A pixel of an illumination map that keeps all surfaces: put in front of the pixel's list.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(binding = 0, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 1, scalar) buffer Heads { uint heads[]; };  // [tiles][side][side]
layout(binding = 2, scalar) writeonly buffer Fragments { Fragment fragments[]; };
layout(binding = 3, scalar) buffer Count { FragmentCount total; };
layout(location = 0) in vec2 place;

void main()
{
    const uint index = atomicAdd(total.count, 1u);
    if (index >= total.capacity) {
        atomicMax(total.most, index + 1u);
        return;
    }
    const uint side = p.layout_.side;
    const uvec2 corner = uvec2(p.tile % p.layout_.columns, p.tile / p.layout_.columns) * side;
    const uvec2 pixel = uvec2(gl_FragCoord.xy) - corner;
    const uint head = (p.tile * side + pixel.y) * side + pixel.x;
    fragments[index] =
        Fragment(surface_at(p, place), gl_FragCoord.z, atomicExchange(heads[head], index));
}
