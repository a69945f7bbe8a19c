#version 460
#include "visibility/hemicube.shared.h"
#include "core/hash.glsl"

// A masked surface is there where alpha reaches the cut-off; a blended one is there with
// probability alpha, so that over many shots it lets 1 - alpha of the light through.

layout(push_constant, scalar) uniform Params { HemicubeParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 1) uniform sampler2D base_color;
layout(location = 0) in vec3 look;

void main()
{
    const float alpha = textureLod(base_color, look.xy, 0.0).a * look.z;
    float threshold = p.cutoff;
    if (threshold < 0.0) {
        const uvec2 pixel = uvec2(gl_FragCoord.xy);
        const uint where = hash(pixel.x ^ hash(pixel.y ^ hash(floatBitsToUint(gl_FragCoord.z))));
        threshold = unit_float(hash(where ^ eyes[p.eye].random));
        if (alpha <= threshold)
            discard;
    } else if (alpha < threshold)
        discard;
}
