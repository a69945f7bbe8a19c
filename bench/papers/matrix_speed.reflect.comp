#version 460
#include "../bench/papers/matrix_speed.shared.h"

// Naive radiosity between its products, Eq. (4): what arrived is added up, and sent on coloured.

layout(local_size_x = kRowLanes) in;
layout(push_constant, scalar) uniform Params { ReflectParams p; };
layout(scalar) readonly buffer Color { vec3 color[]; };  // [n]
layout(scalar) readonly buffer Incident { float incident[]; };  // [3][width]
layout(scalar) writeonly buffer Excident { float excident[]; };
layout(scalar) buffer Total { vec3 total[]; };  // [n]

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    for (uint c = 0u; c < 3u; ++c) {
        const float light = incident[c * p.width + i];
        total[i][c] += light;
        excident[c * p.width + i] = light * color[i][c];
    }
}
