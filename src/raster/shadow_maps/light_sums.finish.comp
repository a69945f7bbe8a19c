#version 460
#include "raster/shadow_maps/light_sums.shared.h"

// Adds the light of one source, H = U N / D, to the lumels, and clears its sums.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) buffer Sums { LightSums sums[]; };
layout(scalar) buffer Irradiance { vec3 irradiance[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const LightSums sum = sums[i];
    for (uint c = 0u; c < 3u; ++c)
        if (sum.known[c] > 0.0)
            irradiance[i][c] += sum.open[c] * (sum.arrived[c] / sum.known[c]);
    sums[i] = LightSums(vec3(0.0), vec3(0.0), vec3(0.0));
}
