#pragma once
// π in single precision.

#include <numbers>

namespace lumel {

inline constexpr float kPi = std::numbers::pi_v<float>;

}  // namespace lumel
