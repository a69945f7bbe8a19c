#pragma once
// Options of progressive refinement.

#include <cstdint>

#include "raster/eyes/view_options.h"

namespace lumel {

struct ProgressiveOptions {
    std::uint32_t seed = 1;  ///< of the near field, and of the points at which lumels
                             ///< receive; patches shoot from the same ones
    /// A patch sends at most 1 / this of all light; shadows from 512 points look soft. Fewer are
    /// the thesis' low quality.
    std::uint32_t shooters = 512;
    ViewOptions views{.projection = Projection::hemicube, .hemicube = 256, .batch = 16};
};

}  // namespace lumel
