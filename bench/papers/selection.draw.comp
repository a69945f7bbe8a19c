#version 460
#include "../bench/papers/selection.shared.h"
#include "solve/shooting/power_pyramid.glsl"

// One draw from a pyramid.

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Params { DrawParams p; };
layout(scalar) readonly buffer Weights { float weights[]; };
layout(scalar) writeonly buffer Lumels { uint lumels[]; };

void main()
{
    Drawn drawn;
    DRAW_FROM(weights, p.pyramid, p.u, drawn)
    lumels[p.draw] = drawn.lumel;
}
