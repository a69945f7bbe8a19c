#version 460
#include "visibility/illumination_maps.shared.h"
#include "core/hash.glsl"
#include "visibility/alpha.glsl"
#include "visibility/illumination.glsl"

// illumination.list.frag for surfaces with alpha.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(binding = 0, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 1) uniform sampler2D base_color;
layout(location = 1) in vec3 look;
layout(binding = 2, scalar) buffer Heads { uint heads[]; };  // [tiles][side][side]
layout(binding = 3, scalar) writeonly buffer Fragments { Fragment fragments[]; };
layout(binding = 4, scalar) buffer Count { FragmentCount total; };
layout(location = 0) in vec2 place;

void main()
{
    const float alpha = textureLod(base_color, look.xy, 0.0).a * look.z;
    if (!blocks(alpha, p.cutoff, gl_FragCoord.xy, gl_FragCoord.z, views[p.view].random))
        discard;
    const uint index = atomicAdd(total.count, 1u);
    if (index >= total.capacity)
        return;
    const uint side = p.layout_.side;
    const uvec2 corner = uvec2(p.tile % p.layout_.columns, p.tile / p.layout_.columns) * side;
    const uvec2 pixel = uvec2(gl_FragCoord.xy) - corner;
    const uint head = (p.tile * side + pixel.y) * side + pixel.x;
    fragments[index] =
        Fragment(surface_at(p, place), gl_FragCoord.z, atomicExchange(heads[head], index));
}
