#pragma once
// Points of the unit square, evenly spread, of which it is known how many there will be.
//
//   [HN04] J. Hannay, J. Nye. Fibonacci numerical integration on a sphere. 2004.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Point `index` of `count` in [0, 1)²: a lattice of the golden ratio, moved by a shift of its own
/// for every `key`. The first coordinate takes each count-th part of the interval once.
inline glm::vec2 lattice_point(std::uint32_t index, std::uint32_t count, std::uint32_t key)
{
    constexpr std::uint32_t kGolden = 2654435769u;  // 2³² / φ: the sum wraps as fractions do
    // Mixes the key's bits (MurmurHash3's finalizer).
    std::uint32_t mixed = key ^ (key >> 16);
    mixed *= 0x85ebca6bu;
    mixed ^= mixed >> 13;
    mixed *= 0xc2b2ae35u;
    mixed ^= mixed >> 16;
    const float shift = float(mixed >> 8) * 0x1p-24f;
    const std::uint32_t y = mixed * kGolden + index * kGolden;
    return {(float(index) + shift) / float(count), float(y >> 8) * 0x1p-24f};
}

}  // namespace lumel
