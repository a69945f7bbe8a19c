#pragma once
// Real spherical harmonics of bands 0, 1 and 2, and their irradiance. docs/directional.md documents
// them for readers of the files.
//
// [RH01] R. Ramamoorthi, P. Hanrahan. An Efficient Representation for Irradiance Environment Maps.
//        SIGGRAPH 2001.

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

inline constexpr int kMaxBands = 3;
inline constexpr int kMaxCoefficients = kMaxBands * kMaxBands;

/// Number of coefficients of bands 0…order.
constexpr int coefficient_count(int order)
{
    return (order + 1) * (order + 1);
}

/// Band l of coefficient i = l² + l + m.
constexpr int band_of(int i)
{
    return i < 1 ? 0 : (i < 4 ? 1 : 2);
}

/// A_l: factor from radiance to irradiance per band: π, 2π/3, π/4. [RH01] Eq. (8)
inline constexpr std::array<float, kMaxBands> kCosineLobe = {3.14159265f, 2.09439510f, 0.78539816f};

/// Y_lm of a unit direction at index l² + l + m, orthonormal over the sphere.
std::array<float, kMaxCoefficients> harmonics(const glm::vec3& direction);

/// H(n) = Σ A_l c_lm Y_lm(n) [lx], possibly negative. coefficients [4 or 9]: radiance [cd/m²].
glm::vec3 irradiance_at(std::span<const glm::vec3> coefficients, const glm::vec3& normal);

}  // namespace lumel
