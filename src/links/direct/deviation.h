#pragma once
// How far the estimates of a lumel are off, as its neighbours tell.

#include <cstdint>
#include <vector>

namespace lumel {

/// The root of the mean of `square` over the neighbours of each lumel in `order` [N] and itself,
/// which counts `own` times as much: rays that follow what a lumel itself shows make the error look
/// smaller than it is. square and result [N] by lumel.
std::vector<double> deviation_nearby(const std::vector<double>& square,
                                     const std::vector<std::uint32_t>& order, double own);

}  // namespace lumel
