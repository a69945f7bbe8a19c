#pragma once
// Error metrics between two maps.

#include <limits>

#include "base/core/image.h"

namespace lumel {

/// Over all texels with alpha > 0 in both maps, in R, G and B.
struct MapError {
    double relative_rmse = 0.0;    ///< √mean(d²) / mean(reference)
    double normalized_rmse = 0.0;  ///< √mean(d²) / (largest - smallest of the reference)
    double rel_mse = 0.0;    ///< mean(d² / (reference² + ε²)), ε = 1 % of the mean reference
    double bias = 0.0;       ///< mean(d) / mean(reference)
    double p95 = 0.0;        ///< 95th percentile of |d| / mean(reference)
    double max = 0.0;        ///< largest |d| / mean(reference)
    std::size_t texels = 0;  ///< compared
};

/// True if the maps have the same size, and alpha > 0 in the same texels.
bool covers_the_same(const Image& map, const Image& reference);

/// Excludes texels whose reference is above `most` in a channel: lamps in an image. Throws
/// Error{input} if sizes differ or no texel is covered in both.
MapError compare_maps(const Image& map, const Image& reference,
                      double most = std::numeric_limits<double>::infinity());

/// d| / mean(reference) as a heat map, RGBA, display-referred; `full_scale` has the last colour.
Image heat_map(const Image& map, const Image& reference, double full_scale = 0.1);

}  // namespace lumel
