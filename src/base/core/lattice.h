#pragma once
// Point sets that cover the unit square evenly; the number of points may be known beforehand.
//
//   [HN04] J. Hannay, J. Nye. Fibonacci numerical integration on a sphere. 2004.
//   [Rob18] M. Roberts. The Unreasonable Effectiveness of Quasirandom Sequences. 2018.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Hashes a key (MurmurHash3's finalizer).
inline std::uint32_t mixed_bits(std::uint32_t key)
{
    std::uint32_t mixed = key ^ (key >> 16);
    mixed *= 0x85ebca6bu;
    mixed ^= mixed >> 13;
    mixed *= 0xc2b2ae35u;
    mixed ^= mixed >> 16;
    return mixed;
}

/// Maps the upper 24 bits to [0, 1).
inline float unit_float(std::uint32_t bits)
{
    return float(bits >> 8) * 0x1p-24f;
}

/// Point `index` of `count` in [0, 1)²: a golden-ratio lattice, shifted by `key`. The first
/// coordinates are stratified into `count` intervals.
inline glm::vec2 lattice_point(std::uint32_t index, std::uint32_t count, std::uint32_t key)
{
    constexpr std::uint32_t kGolden = 2654435769u;  // 2³² / φ: unsigned overflow wraps the fraction
    const std::uint32_t mixed = mixed_bits(key);
    const float shift = unit_float(mixed);
    return {(float(index) + shift) / float(count), unit_float(mixed * kGolden + index * kGolden)};
}

/// Point `index` of a sequence in [0, 1)² with a start given by `key` [Rob18]. Together with a
/// lattice_point of the same index it covers [0, 1)⁴ evenly, as two lattice points do not.
inline glm::vec2 sequence_point(std::uint32_t index, std::uint32_t key)
{
    constexpr std::uint32_t kX = 3242174889u, kY = 2447445414u;  // 2³² / ψ, / ψ²; ψ³ = ψ + 1
    const std::uint32_t x = mixed_bits(key), y = mixed_bits(x);
    return {unit_float(x + index * kX), unit_float(y + index * kY)};
}

}  // namespace lumel
