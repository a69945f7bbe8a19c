#pragma once
// Draws lumels, and points on them, on the CPU with probability proportional to power.

#include <cstdint>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

class PowerDraw {
public:
    /// brightness: [N] 𝓛(B) [lm/m²]; buried lumels count as 0. `world` must outlive this.
    PowerDraw(const WorldLumels& world, const Lumels& lumels, std::vector<float> brightness);

    /// Φ = Σ A 𝓛(B) [lm]
    double power() const { return running_.empty() ? 0.0 : running_.back(); }

    /// Inverts the cumulative power: lumel for `place` [lm] in [0, power()). Requires power() > 0.
    std::uint32_t lumel(double place) const;

    /// Point on the lumel, uniform for (s, t) in the unit square.
    LumelPoint point(std::uint32_t lumel, const glm::vec2& st) const
    {
        return world_->point_on(lumel, st);
    }

    /// Probability density of its points, 𝓛(B) / Φ [1/m²]. Requires power() > 0.
    float density(std::uint32_t lumel) const { return brightness_[lumel] / float(power()); }

private:
    const WorldLumels* world_;
    std::vector<float> brightness_;
    std::vector<double> running_;  ///< [N] Σ A 𝓛(B) up to and including each
};

}  // namespace lumel
