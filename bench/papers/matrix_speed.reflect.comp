#version 460
#include "../bench/papers/matrix_speed.shared.h"

// Naive radiosity between its products, Eq. (4): what arrived is added up, and sent on coloured.

layout(local_size_x = kRowLanes) in;
layout(push_constant, scalar) uniform Params { ReflectParams p; };
layout(binding = 0, scalar) readonly buffer Color { vec3 color[]; };        // [n]
layout(binding = 1, scalar) readonly buffer Incident { float incident[]; };  // [3][width]
layout(binding = 2, scalar) writeonly buffer Excident { float excident[]; };
layout(binding = 3, scalar) buffer Total { vec3 total[]; };  // [n]

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
