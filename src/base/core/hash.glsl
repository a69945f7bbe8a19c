#ifndef LUMEL_CORE_HASH_GLSL
#define LUMEL_CORE_HASH_GLSL

// Integer hashes and their conversion to floats.

// A bijection of 32 bits with good avalanche (the "lowbias32" constants of C. Wellons).
uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// 0 ≤ result < 1, from the upper 24 bits.
float unit_float(uint x)
{
    return float(x >> 8) * (1.0 / 16777216.0);
}

#endif
