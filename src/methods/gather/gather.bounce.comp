#version 460
#include "methods/gather/gather.shared.h"

// Lumels receive the light that their hemicubes gathered, and send it on at once:
//
//     B_i = E_i + ρ_i H_i                                                         Eq. (2.2.2)
//
// H_i is the light of the last bounce, or the mean over the lumel's points.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { BounceParams p; };
layout(scalar) readonly buffer Order { uint order[]; };
layout(scalar) readonly buffer LinkSet { vec3 gathered[]; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) buffer Sums { vec3 sums[]; };  // [2][N]
layout(scalar) writeonly buffer Change { vec3 change[]; };
layout(scalar) buffer Irradiance { vec3 irradiance[]; };
layout(scalar) writeonly buffer Radiosity { vec3 radiosity[]; };

void main()
{
    const uint m = gl_GlobalInvocationID.x;
    if (m >= p.lumels)
        return;
    const uint i = order[p.first + m];
    vec3 arrived = gathered[m * p.channels];
    if (p.channels > 1u)
        arrived = vec3(arrived.r, gathered[m * p.channels + 1u].g, gathered[m * p.channels + 2u].b);
    if (p.averaged != 0u) {
        sums[p.half_index * p.count + i] += arrived;
        arrived = (sums[i] + sums[p.count + i]) / float(p.taken.x + p.taken.y);
    }
    change[i] = arrived - irradiance[i];
    irradiance[i] = arrived;
    radiosity[i] = emission[i] + surface[i].rgb * arrived;
}
