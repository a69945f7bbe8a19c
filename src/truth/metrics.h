#pragma once
// How far a map is from another.

#include <limits>

#include "base/core/image.h"

namespace lumel {

/// All over texels whose alpha is above 0 in both maps, R, G and B alike.
struct MapError {
    double relative_rmse = 0.0;    ///< √mean(d²) / mean(reference)
    double normalized_rmse = 0.0;  ///< √mean(d²) / (largest - smallest of the reference)
    double rel_mse = 0.0;    ///< mean(d² / (reference² + ε²)), ε = 1 % of the mean reference
    double bias = 0.0;       ///< mean(d) / mean(reference)
    double p95 = 0.0;        ///< 95th percentile of |d| / mean(reference)
    double max = 0.0;        ///< largest |d| / mean(reference)
    std::size_t texels = 0;  ///< compared
};

/// Texels whose reference is above `most` in a channel are left out: lamps in a picture.
/// Throws Error{input} if sizes differ or nothing is left that is covered in both.
MapError compare_maps(const Image& map, const Image& reference,
                      double most = std::numeric_limits<double>::infinity());

/// |d| / mean(reference) as a heat map, RGBA, display-referred; `full_scale` is the hottest.
Image heat_map(const Image& map, const Image& reference, double full_scale = 0.1);

}  // namespace lumel
