#pragma once
// Errors free of the noise of what they are taken against.

#include <algorithm>
#include <cmath>
#include <vector>

#include "truth/metrics.h"

namespace lumel::bench {

/// Against one truth, or two independent halves of it, whose noise is left out:
/// (p - a)(p - b) = ((p - a)² + (p - b)² - (a - b)²) / 2.
inline MapError error_of(const Image& map, const std::vector<Image>& halves)
{
    MapError error = compare_maps(map, halves[0]);
    if (halves.size() == 1)
        return error;
    const MapError second = compare_maps(map, halves[1]);
    const double apart = compare_maps(halves[0], halves[1]).relative_rmse;
    const double square = error.relative_rmse * error.relative_rmse +
                          second.relative_rmse * second.relative_rmse - apart * apart;
    error.relative_rmse = std::sqrt(std::max(0.5 * square, 0.0));
    error.bias = 0.5 * (error.bias + second.bias);
    return error;
}

}  // namespace lumel::bench
