// Sums SUMMAND values over a workgroup, in a fixed order. Before including this, define the macro
// SUMMAND (the type) and the size of the group, a power of two; define `plus` after it. Can be
// included for one type only.

#extension GL_EXT_control_flow_attributes : require

#ifndef SUMMAND
#error "group_sum.glsl: define SUMMAND"
#endif

SUMMAND plus(SUMMAND a, SUMMAND b);

shared SUMMAND summands[gl_WorkGroupSize.x];

// Sum of `mine` over the workgroup. All invocations must call this.
SUMMAND add_over_group(SUMMAND mine)
{
    const uint me = gl_LocalInvocationID.x;
    summands[me] = mine;
    barrier();
    [[dont_unroll]] for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        if (me < width)
            summands[me] = plus(summands[me], summands[me + width]);
        barrier();
    }
    const SUMMAND sum = summands[0];
    barrier();  // before the next sum
    return sum;
}
