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
    const ParallelView view = views[p.view];
    const vec4 base = textureLod(base_color, look.xy, 0.0) * vec4(vec3(1.0), look.z);
    const Opacity opacity = opacity_of(p.passage, base, view.channel);
    const float chance = chance_at(gl_FragCoord.xy, gl_FragCoord.z, view.random);
    if (chance >= opacity.blocked)
        discard;
    const uint surface = chance < opacity.there ? surface_at(p, place) : kAbsorbing;
    const uint index = atomicAdd(total.count, 1u);
    if (index >= total.capacity) {
        atomicMax(total.most, index + 1u);
        return;
    }
    const uint side = p.layout_.side;
    const uvec2 corner = uvec2(p.tile % p.layout_.columns, p.tile / p.layout_.columns) * side;
    const uvec2 pixel = uvec2(gl_FragCoord.xy) - corner;
    const uint head = (p.tile * side + pixel.y) * side + pixel.x;
    fragments[index] = Fragment(surface, gl_FragCoord.z, atomicExchange(heads[head], index));
}
