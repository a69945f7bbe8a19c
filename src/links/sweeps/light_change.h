#pragma once
// Change of the light that sub-lumels send, in a sweep.

#include <cmath>
#include <cstddef>

#include "links/sweeps/sweeps.shared.h"

namespace lumel {

inline double sum_of_channels(const glm::vec4& light)
{
    return double(light.x + light.y + light.z);
}

struct LightChange {
    double squares = 0.0;  ///< squared changes, relative to each sub-lumel's own light
    double light = 0.0;    ///< sent afterwards, summed over channels [lm/m²]
    std::size_t lit = 0;   ///< sub-lumels with light

    void add(const SweepSums& sums)
    {
        squares += double(sums.squares);
        light += double(sums.light);
        lit += sums.lit;
    }
    /// RMS of relative changes.
    double size() const { return lit > 0 ? std::sqrt(squares / double(lit)) : 0.0; }
};

}  // namespace lumel
