#pragma once
// What bounces have in common with their own transpose.

#include <span>

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/elements.h"

namespace lumel {

/// K = D M C^-1 D^-1 with colours C and D = √area, M made of form factors: then K is symmetric, its
/// channels are alike (the first bounce is the same in all) and its rows count as their patches'
/// areas do. Where C is 0, M does not determine K: then K's other half does, or its other channels.
/// Throws Error{input} unless elements has all of every patch.
ColorMatrix balanced(const ColorMatrix& matrix, const Elements& elements);

/// M = D^-1 K D C
ColorMatrix unbalanced(const ColorMatrix& balanced, std::span<const glm::vec3> color,
                       std::span<const float> root_area);

/// D C [n]: what patches' light is multiplied by before K; and D^-1: after it.
std::vector<glm::vec3> sent_weights(std::span<const glm::vec3> color,
                                    std::span<const float> root_area);
std::vector<float> received_weights(std::span<const float> root_area);

/// √area [n]
std::vector<float> root_areas(const Elements& elements);

}  // namespace lumel
