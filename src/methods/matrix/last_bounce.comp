#version 460
#include "methods/matrix/last_bounce.shared.h"
#include "solve/transport/lumel_rows.shared.h"

// Last bounce, from patches to lumels: H_i = Σ_p F_ip color_p (x_p + y_p), x the direct and y the
// reflected light of the patches. One invocation processes a lumel in all states, so that its row
// is read once.

layout(local_size_x = kLastBounceGroup) in;
layout(push_constant, scalar) uniform Params { LastBounceParams p; };
layout(scalar) readonly buffer First { uint first[]; };  // [N + 1]
layout(scalar) readonly buffer Entries { RowEntry entries[]; };
layout(scalar) readonly buffer Color { vec3 color[]; };  // [n]
layout(scalar) readonly buffer Direct { vec3 direct[]; };  // x, [states][n]
layout(scalar) readonly buffer Reflected { vec3 reflected[]; };  // y
layout(scalar) writeonly buffer Result { vec3 result[]; };  // [states][N]

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.lumels)
        return;
    vec3 sums[kLastBounceStates];
    for (uint s = 0u; s < kLastBounceStates; ++s)
        sums[s] = vec3(0.0);
    for (uint k = first[i]; k < first[i + 1u]; ++k) {
        const uint patch_ = entries[k].code >> 16u;
        const vec3 factor = unpackHalf2x16(entries[k].code).x / kRowScale * color[patch_];
        for (uint s = 0u; s < p.states; ++s) {
            const uint at = s * p.patches + patch_;
            sums[s] += factor * (direct[at] + reflected[at]);
        }
    }
    for (uint s = 0u; s < p.states; ++s)
        result[s * p.lumels + i] = sums[s];
}
