#pragma once
// Options of the default method.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"

namespace lumel {

/// Who casts rays.
enum class Rays {
    automatic,  ///< a device that is no CPU, by queries or else by raster; or the host
    host,
    query,   ///< the device's ray queries
    raster,  ///< drawings by the device, for rays that leave lumels; others go to the host
};

struct LinksOptions {
    std::uint32_t seed = 1;
    SampleRule rule = SampleRule::area;
    bool filter = true;  ///< averages lumels with others of their chart that look alike
    Rays rays = Rays::automatic;
    /// Lumels share directions with those so many texels off, in 16 sets for 4. 0: every lumel has
    /// its own, but for Rays::raster, which takes kInterleaved.
    std::uint32_t interleaved = 0;
};

inline constexpr std::uint32_t kInterleaved = 4;

}  // namespace lumel
