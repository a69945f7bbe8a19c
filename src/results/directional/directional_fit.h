#pragma once
// Spherical harmonics fitted to irradiance on the visible side of a surface. See
// directional_fit.cpp.

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/spherical_harmonics.h"
#include "results/directional/directional.shared.h"

namespace lumel {

/// Fits coefficients to light from above a surface, so that they reproduce its irradiance.
class DirectionalFit {
public:
    /// order: 1 or 2.
    explicit DirectionalFit(int order);

    int order() const { return order_; }
    /// [kElevations], for directional.glsl.
    const std::vector<FitRow>& rows() const { return rows_; }

    /// Coefficients of a lumel with this unit normal for radiance × solid angle 1 from a unit
    /// direction; 0 beyond the order.
    std::array<float, kMaxCoefficients> coefficients_of(const glm::vec3& from,
                                                        const glm::vec3& normal) const;

    /// Minimal change of the coefficients [4 or 9] of radiance [cd/m²] that makes
    /// irradiance_at(coefficients, normal) equal to `irradiance` [lx].
    void match(std::span<glm::vec3> coefficients, const glm::vec3& normal,
               const glm::vec3& irradiance) const;

private:
    int order_;
    std::vector<FitRow> rows_;
    std::array<float, kMaxBands> spread_{};  ///< share of an irradiance error per band's Y_l0
};

/// Matches coefficients from noisy shots, whose noise is mostly in the amount of light: scales them
/// first, then matches, then keeps irradiance ≥ 0 at normals tilted by up to 60°.
void settle(const DirectionalFit& fit, std::span<glm::vec3> coefficients, const glm::vec3& normal,
            const glm::vec3& irradiance);

}  // namespace lumel
