#version 460
#include "shooting/power_pyramid.shared.h"
#include "shooting/power_pyramid.glsl"

// One draw from a pyramid.

struct DrawParams {
    PyramidLayout layout_;
    float u;    // 0…1
    uint draw;  // which of them this is
};

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Params { DrawParams p; };
layout(binding = 0, scalar) readonly buffer Pyramid { float pyramid[]; };
layout(binding = 1, scalar) writeonly buffer Lumels { uint lumels[]; };

void main()
{
    const PyramidLayout layout_ = p.layout_;
    Drawn drawn;
    DRAW_FROM(pyramid, p.u)
    lumels[p.draw] = drawn.lumel;
}
