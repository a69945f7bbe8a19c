#version 460
#include "solve/matrix/vectors.shared.h"

// Brings colours of patches, [states][n], into the matrix's order, each channel in a plane of its
// own: [states][3][width], the rest filled with 0.

layout(local_size_x = kVectorGroup) in;
layout(push_constant, scalar) uniform Params { PatchGatherParams p; };
layout(scalar) readonly buffer Order { uint order[]; };  // [n] patch at each place
layout(scalar) readonly buffer Weight { vec3 weight[]; };  // [n] by patch
layout(scalar) readonly buffer Colors { vec3 colors[]; };
layout(scalar) writeonly buffer Planes { float planes[]; };

void main()
{
    const uint state = gl_GlobalInvocationID.x / p.width;
    const uint place = gl_GlobalInvocationID.x % p.width;
    if (state >= p.states)
        return;
    vec3 color = vec3(0.0);
    if (place < p.count)
        color = colors[state * p.count + order[place]] * weight[order[place]];
    for (uint c = 0u; c < 3u; ++c)
        planes[(state * 3u + c) * p.width + place] = color[c];
}
