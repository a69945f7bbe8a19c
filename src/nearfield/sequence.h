#pragma once
// Stratified points: the first four Sobol dimensions, moved by a hashed digital shift.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// A well-mixed number for two.
inline std::uint32_t hash_two(std::uint32_t a, std::uint32_t b)
{
    std::uint32_t x = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Dimensions 2 pair and 2 pair + 1 of Sobol point `index` in [0, 1)², shifted by `key`. Any
/// aligned run of 2^k points is stratified. pair: 0 or 1, index < 256.
inline glm::vec2 sobol_pair(std::uint32_t index, int pair, std::uint32_t key)
{
    // Direction numbers, one row for each dimension, cut to 8 bits.
    static constexpr std::uint32_t kColumns[4][8] = {
        {0x80, 0x40, 0x20, 0x10, 0x08, 0x04, 0x02, 0x01},
        {0x80, 0xc0, 0xa0, 0xf0, 0x88, 0xcc, 0xaa, 0xff},
        {0x80, 0xc0, 0x60, 0x90, 0xe8, 0x5c, 0x8e, 0xc5},
        {0x80, 0xc0, 0x20, 0x50, 0xf8, 0x74, 0xa2, 0x93},
    };
    std::uint32_t bits[2] = {0, 0};
    for (int column = 0; column < 8; ++column)
        if (index >> column & 1u)
            for (int k = 0; k < 2; ++k)
                bits[k] ^= kColumns[2 * pair + k][column] << 24;
    const std::uint32_t x = bits[0] ^ key;
    const std::uint32_t y = bits[1] ^ hash_two(key, 0x68e31da4u);
    return {float(x >> 8) * 0x1p-24f, float(y >> 8) * 0x1p-24f};
}

}  // namespace lumel
