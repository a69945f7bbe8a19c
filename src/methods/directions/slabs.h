#pragma once
// Into how many slabs global directions are cut.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include "methods/directions/options.h"
#include "raster/world/world.h"

namespace lumel {

/// Most slabs that are tried: they have 15 maps for a direction.
inline constexpr std::uint32_t kMaxTriedSlabs = 8;

/// C_n(K), [TN11] section 6: the chance that a surface is among n lookups where K compete.
double chance_found(double surfaces, int lookups);

/// The slabs of the options; of "auto" (0) the fewest with which a surface is likely enough to be
/// among the lookups. That is measured: some directions are drawn with 1, 2, 4, … slabs. Their maps
/// have to fit a bounded memory beside that. side: of maps [pixels]. Waits for the device.
std::uint32_t suitable_slabs(const gpu::Device& device, const World& world, std::uint32_t side,
                             const DirectionsOptions& options);

}  // namespace lumel
