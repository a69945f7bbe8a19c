#pragma once
// Stratified points: Sobol's, with a hashed digital shift.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Hash of two numbers.
inline std::uint32_t hash_two(std::uint32_t a, std::uint32_t b)
{
    std::uint32_t x = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// The first two Sobol dimensions in [0, 1)², shifted by `key`: any aligned run of 2^k points is
/// stratified. index < 256.
inline glm::vec2 sobol_pair(std::uint32_t index, std::uint32_t key)
{
    // Direction numbers, one row per dimension, truncated to 8 bits.
    static constexpr std::uint32_t kColumns[2][8] = {
        {0x80, 0x40, 0x20, 0x10, 0x08, 0x04, 0x02, 0x01},
        {0x80, 0xc0, 0xa0, 0xf0, 0x88, 0xcc, 0xaa, 0xff},
    };
    std::uint32_t x = key, y = hash_two(key, 0x68e31da4u);
    for (int column = 0; column < 8; ++column)
        if (index >> column & 1u) {
            x ^= kColumns[0][column] << 24;
            y ^= kColumns[1][column] << 24;
        }
    return {float(x >> 8) * 0x1p-24f, float(y >> 8) * 0x1p-24f};
}

}  // namespace lumel
