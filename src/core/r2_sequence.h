#pragma once
// The additive recurrence R2: points of the unit square that stay evenly spread however many are
// taken.
//
//   [Rob18] M. Roberts. The Unreasonable Effectiveness of Quasirandom Sequences. 2018.

#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Point `index` of the sequence in [0, 1)², moved by a start of its own for every `key`.
inline glm::vec2 r2_point(std::uint32_t index, std::uint32_t key)
{
    // 2³² / g and 2³² / g² with g³ = g + 1: the sum wraps as fractions do.
    constexpr std::uint32_t kStepX = 3242174889u, kStepY = 2447445414u;
    // Mixes the key's bits (MurmurHash3's finalizer).
    std::uint32_t mixed = key ^ (key >> 16);
    mixed = (mixed * 0x85ebca6bu) ^ ((mixed * 0x85ebca6bu) >> 13);
    mixed = (mixed * 0xc2b2ae35u) ^ ((mixed * 0xc2b2ae35u) >> 16);
    const std::uint32_t x = mixed + index * kStepX;
    const std::uint32_t y = mixed * 0x9e3779b1u + index * kStepY;
    return {float(x >> 8) * 0x1p-24f, float(y >> 8) * 0x1p-24f};
}

}  // namespace lumel
