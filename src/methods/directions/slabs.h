#pragma once
// Number of slabs into which global directions are cut.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include "methods/directions/options.h"
#include "raster/world/world.h"

namespace lumel {

/// Maximum number of slabs tried: 15 maps per direction.
inline constexpr std::uint32_t kMaxTriedSlabs = 8;

/// C_n(K), [TN11] section 6: the probability that a surface is among n lookups where K compete.
double chance_found(double surfaces, int lookups);

/// The slabs of the options. For "auto" (0) the smallest number with which a surface is among the
/// lookups with high probability, measured by rendering some directions with 1, 2, 4, … slabs, and
/// limited by the memory of their maps. side: of maps [pixels]. Waits for the device.
std::uint32_t suitable_slabs(const gpu::Device& device, const World& world, std::uint32_t side,
                             const DirectionsOptions& options);

}  // namespace lumel
