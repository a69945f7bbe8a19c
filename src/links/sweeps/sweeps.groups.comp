#version 460
#include "links/sweeps/sweeps.shared.h"

// Sums change and light over spans of groups, one per workgroup.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { SweepGroupsParams p; };
layout(scalar) readonly buffer Members { uint members[]; };
layout(scalar) readonly buffer Spans { GroupSpan spans[]; };
layout(scalar) readonly buffer Areas { float areas[]; };
layout(scalar) readonly buffer Sent { vec4 sent[]; };
layout(scalar) readonly buffer Next { vec4 next[]; };
layout(scalar) writeonly buffer Sums { GroupSums sums[]; };

shared GroupSums terms[kGroup];

void main()
{
    const uint me = gl_LocalInvocationID.x;
    const uint span = p.range.first / kGroup + gl_WorkGroupID.x;
    const uint member = spans[span].first + me;
    terms[me] = GroupSums(vec3(0.0), vec3(0.0));
    if (member < spans[span].last) {
        const uint part = members[member];
        terms[me] = group_sums(sent[part].xyz, next[part].xyz, areas[part]);
    }
    barrier();
    if (me == 0u) {
        GroupSums sum = terms[0];
        for (uint k = 1u; k < kGroup; ++k)
            sum = plus(sum, terms[k]);
        sums[span] = sum;
    }
}
