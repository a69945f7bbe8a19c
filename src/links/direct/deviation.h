#pragma once
// Standard deviation of lumel estimates, as RMS over neighbours.

#include <cstdint>
#include <vector>

namespace lumel {

/// Root of the mean of `square` over each lumel, with weight `own`, and its neighbours in `order`
/// [N]. Rays allocated by a lumel's own error alone would make that error look too small. square,
/// result: [N] by lumel.
std::vector<double> deviation_nearby(const std::vector<double>& square,
                                     const std::vector<std::uint32_t>& order, double own);

}  // namespace lumel
