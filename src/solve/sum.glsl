// Adds up one Terms per invocation over the workgroup, in an order that never changes.

shared Terms shared_terms[kSumGroup];

Terms add_over_group(Terms mine)
{
    const uint me = gl_LocalInvocationID.x;
    shared_terms[me] = mine;
    barrier();
    for (uint width = kSumGroup / 2u; width > 0u; width /= 2u) {
        if (me < width)
            for (uint c = 0u; c < kTermColumns; ++c)
                shared_terms[me].column[c] += shared_terms[me + width].column[c];
        barrier();
    }
    return shared_terms[0];
}
