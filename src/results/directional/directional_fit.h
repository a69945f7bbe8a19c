#pragma once
// Spherical harmonics that are right where a surface can see. See directional_fit.cpp.

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/spherical_harmonics.h"
#include "results/directional/directional.shared.h"

namespace lumel {

/// How light from above a surface becomes coefficients that give back its irradiance.
class DirectionalFit {
public:
    /// order: 1 or 2.
    explicit DirectionalFit(int order);

    int order() const { return order_; }
    /// [kElevations], for directional.glsl.
    const std::vector<FitRow>& rows() const { return rows_; }

    /// What light of radiance × solid angle 1 from a unit direction adds to the coefficients of a
    /// lumel of that unit normal; 0 beyond the order.
    std::array<float, kMaxCoefficients> coefficients_of(const glm::vec3& from,
                                                        const glm::vec3& normal) const;

    /// Changes the coefficients [4 or 9] of radiance [cd/m²] as little as possible so that
    /// irradiance_at(coefficients, normal) is `irradiance` [lx].
    void match(std::span<glm::vec3> coefficients, const glm::vec3& normal,
               const glm::vec3& irradiance) const;

private:
    int order_;
    std::vector<FitRow> rows_;
    std::array<float, kMaxBands> spread_{};  ///< of a gap in irradiance over Y_l0 of each band
};

/// The same for coefficients that were summed from noisy shots, whose noise is mostly in how much
/// light there is: they are scaled first. Then they are kept from promising less than no light to
/// normals tilted by up to 60°.
void settle(const DirectionalFit& fit, std::span<glm::vec3> coefficients, const glm::vec3& normal,
            const glm::vec3& irradiance);

}  // namespace lumel
