#ifndef LUMEL_SHOOTING_LOW_DISCREPANCY_GLSL
#define LUMEL_SHOOTING_LOW_DISCREPANCY_GLSL

// Owen-scrambled Sobol points.
//
//   [Owen95] A. Owen. Randomly permuted (t,m,s)-nets and (t,s)-sequences. 1995.
//   [LK11]   S. Laine, T. Karras. Stratified sampling for stochastic transparency. 2011
//            (the hash below is their nested uniform scramble).

#include "base/core/hash.glsl"

// Flips each bit of bit-reversed x depending on the bits above it.
uint owen_scramble(uint x, uint seed)
{
    x = bitfieldReverse(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return bitfieldReverse(x);
}

// Dimension 0…2 of the Sobol sequence (primitive polynomials 1, x + 1, x² + x + 1), by the
// recurrence of its direction numbers.
uint sobol(uint index, uint dimension)
{
    uint result = 0u;
    uint v = 1u << 31;        // direction number of the current bit
    uint before = 0u;         // direction number of the bit before it
    for (uint bit = 0u; bit < 32u && index != 0u; ++bit, index >>= 1) {
        if ((index & 1u) != 0u)
            result ^= v;
        uint next;
        if (dimension == 0u)
            next = v >> 1;
        else if (dimension == 1u)
            next = v ^ (v >> 1);
        else
            next = bit == 0u ? 3u << 30 : v ^ before ^ (before >> 2);
        before = v;
        v = next;
    }
    return result;
}

// Point `index` of the sequence scrambled by `seed`: x, y, z in [0, 1).
vec3 low_discrepancy_point(uint index, uint seed)
{
    return vec3(unit_float(owen_scramble(sobol(index, 0u), hash(seed ^ 0x68bc21ebu))),
                unit_float(owen_scramble(sobol(index, 1u), hash(seed ^ 0x02e5be93u))),
                unit_float(owen_scramble(sobol(index, 2u), hash(seed ^ 0x967a889bu))));
}

#endif
