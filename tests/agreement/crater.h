#pragma once
// A spherical crater under a sun, whose light has a closed form.
//
//   A. Ingersoll, T. Svitek, B. Murray. Stability of Polar Frosts in Spherical Bowl-Shaped Craters
//   on the Moon, Mercury, and Mars. Icarus 100, 1992.
//
// Between any two points of a sphere of radius R the form factor per area is constant,
// cosθ₁ cosθ₂ / (π r²) = 1 / (4πR²), as both cosines are r / 2R. So every point of a cap of area A
// sees the share f = A / (4πR²) of itself, and all points receive the same reflected light
//
//     H = ρ f (⟨D⟩ + H),      H = ρ f ⟨D⟩ / (1 - ρ f),      ⟨D⟩ = area average of sunlight.
//
// In the shadow H is all there is. All sunlight through the opening, of area O, lands on the cap:
// ⟨D⟩ = E₀ sin(elevation) O / A. What does not fall on the cap leaves through the opening, which is
// convex: f = 1 - O / A, on average of any bowl. The closed form takes A and O of the facets.

#include <string>

#include "../support/temporary_folder.h"
#include "atlas/packing/lumel.shared.h"

namespace lumel::test {

/// The crater as a file, and its light.
class Crater {
public:
    Crater();

    const std::string& path() const { return path_; }
    /// ⟨D⟩ [lx]
    double mean_sunlight() const;
    /// H [lx]
    double reflected() const;
    /// True where no point of a lumel sees the sun.
    static bool in_shadow(const Lumel& lumel);

private:
    TemporaryFolder folder_;
    std::string path_;
    double area_ = 0.0, opening_ = 0.0;  ///< A, O [m²]
};

}  // namespace lumel::test
