#version 460
#include "../tests/solve/shooting/draw.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/power_pyramid.glsl"

// Draws many lumels from a pyramid, each with a random number of its own.

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Params { DrawParams p; };
layout(scalar) readonly buffer Weights { float weights[]; };
layout(scalar) writeonly buffer Lumels { uint lumels[]; };
layout(scalar) writeonly buffer Chance { float chance[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    Drawn drawn;
    DRAW_FROM(weights, p.pyramid, unit_float(hash(hash(i) ^ 0x51ed270bu)), drawn)
    lumels[i] = drawn.lumel;
    chance[i] = drawn.probability;
}
