#pragma once
// Any number of reflections in one matrix [SF17].

#include <limits>
#include <span>

#include <glm/glm.hpp>

#include "solve/matrix/color_matrix.h"

namespace lumel {

/// As many reflections as it takes until no light is left.
inline constexpr std::uint32_t kAllBounces = std::numeric_limits<std::uint32_t>::max();

/// F^c, Eq. (5): F_ij color_j. form_factors [n][n] of what reaches i from j, color [n] albedos.
ColorMatrix color_matrix(const SquareMatrix& form_factors, std::span<const glm::vec3> color);

/// Σ_{h=1}^{k} (F^c)^h, Eq. (8) without its h = 0, which is direct light. kAllBounces:
/// (I − F^c)^-1 − I. `once` is F^c, of numbers ≥ 0. Throws Error{input} if a number is negative or
/// none, or if the light of all bounces grows without end.
ColorMatrix bounces(const ColorMatrix& once, std::uint32_t k);

/// y = M x, [n] to [n].
std::vector<glm::vec3> multiply(const ColorMatrix& matrix, std::span<const glm::vec3> x);

}  // namespace lumel
