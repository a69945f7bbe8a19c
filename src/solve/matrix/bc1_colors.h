#pragma once
// The two colours of a BC1 block, of 5, 6 and 5 bits.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace lumel::bc1 {

inline constexpr std::array<int, 3> kBits = {5, 6, 5};

using Coded = std::array<int, 3>;

/// 0…255. The hardware repeats the upper bits below the last one.
constexpr int expand(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

inline glm::vec3 expand(const Coded& code)
{
    return {expand(code[0], kBits[0]), expand(code[1], kBits[1]), expand(code[2], kBits[2])};
}

constexpr std::uint32_t pack(const Coded& code)
{
    return std::uint32_t(code[0] << 11 | code[1] << 5 | code[2]);
}

constexpr Coded unpack(std::uint32_t code)
{
    return {int(code >> 11 & 31u), int(code >> 5 & 63u), int(code & 31u)};
}

}  // namespace lumel::bc1
