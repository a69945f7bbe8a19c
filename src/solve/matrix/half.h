#pragma once
// Half floats, and a scale that suits them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <glm/gtc/packing.hpp>

namespace lumel {

/// Halves keep all their digits from 2^-14 to 2^16: what is to be stored goes to the upper end.
inline constexpr float kLargestHalf = 32768.0f;

/// What one half stands for, so that the largest of |values| becomes kLargestHalf; 1 if all are 0.
inline float half_unit(std::span<const float> values)
{
    float largest = 0.0f;
    for (const float value : values)
        largest = std::max(largest, std::abs(value));
    return largest > 0.0f ? largest / kLargestHalf : 1.0f;
}

inline std::uint16_t to_half(float value)
{
    return glm::packHalf1x16(value);
}

inline float from_half(std::uint16_t bits)
{
    return glm::unpackHalf1x16(bits);
}

}  // namespace lumel
