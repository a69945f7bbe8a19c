#pragma once
// Lumels and points on them, drawn on the host in proportion to what they send.

#include <cstdint>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

class PowerDraw {
public:
    /// brightness: [N] 𝓛(B) [lm/m²]; that of buried lumels does not count. `world` must outlive
    /// this.
    PowerDraw(const WorldLumels& world, const Lumels& lumels, std::vector<float> brightness);

    /// Φ = Σ A 𝓛(B) [lm]
    double power() const { return running_.empty() ? 0.0 : running_.back(); }

    /// The lumel at a place [lm] in [0, power()) of their running sum. There must be power.
    std::uint32_t lumel(double place) const;

    /// A point of that lumel, uniform for (s, t) in the unit square.
    LumelPoint point(std::uint32_t lumel, const glm::vec2& st) const
    {
        return world_->point_on(lumel, st);
    }

    /// 𝓛(B) / Φ [1/m²]: with which points are drawn. There must be power.
    float density(std::uint32_t lumel) const { return brightness_[lumel] / float(power()); }

private:
    const WorldLumels* world_;
    std::vector<float> brightness_;
    std::vector<double> running_;  ///< [N] Σ A 𝓛(B) up to and with each
};

}  // namespace lumel
