// Adds up over a workgroup, in an order that never changes. Its argument is the macro SUMMAND, the
// type that is added up. Declares `plus`, which whoever includes this defines. The group's size,
// declared before, is a power of two. May be included for one type only.

#extension GL_EXT_control_flow_attributes : require

#ifndef SUMMAND
#error "group_sum.glsl: define SUMMAND"
#endif

SUMMAND plus(SUMMAND a, SUMMAND b);

shared SUMMAND summands[gl_WorkGroupSize.x];

// The sum of what each invocation brings. All of the group must come here.
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
    barrier();  // the next sum may begin
    return sum;
}
