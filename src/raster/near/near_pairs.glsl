#ifndef LUMEL_NEARFIELD_NEAR_PAIRS_GLSL
#define LUMEL_NEARFIELD_NEAR_PAIRS_GLSL

// Test for near pairs of lumels. Duplicates is_near() in atlas/near/near_pairs.h.

bool is_near(vec3 centre_i, float size_i, vec3 centre_j, float size_j, float radius)
{
    const vec3 step = centre_j - centre_i;
    const float reach = radius * max(size_i, size_j);
    return dot(step, step) < reach * reach;
}

#endif
