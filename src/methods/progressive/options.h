#pragma once
// Options of progressive refinement.

#include <cstdint>

#include "raster/eyes/view_options.h"

namespace lumel {

struct ProgressiveOptions {
    std::uint32_t seed = 1;  ///< for the near field; patches shoot from fixed points
    /// A patch sends at most 1 / this of all light; shadows from 512 points look soft. Fewer are
    /// the thesis' low quality.
    std::uint32_t shooters = 512;
    ViewOptions views{.projection = Projection::hemicube, .hemicube = 256, .batch = 16};
};

}  // namespace lumel
