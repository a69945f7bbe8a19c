#version 460
#include "shooting/power_pyramid.shared.h"
#include "core/hash.glsl"
#include "shooting/power_pyramid.glsl"

// Draws many lumels from a pyramid, each with a random number of its own.

struct DrawParams {
    PyramidLayout layout_;
    uint count;
};

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Params { DrawParams p; };
layout(binding = 0, scalar) readonly buffer Pyramid { float pyramid[]; };
layout(binding = 1, scalar) writeonly buffer Drawn_ { uint drawn_lumel[]; };
layout(binding = 2, scalar) writeonly buffer Chance { float chance[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const PyramidLayout layout_ = p.layout_;
    Drawn drawn;
    DRAW_FROM(pyramid, unit_float(hash(hash(i) ^ 0x51ed270bu)))
    drawn_lumel[i] = drawn.lumel;
    chance[i] = drawn.probability;
}
