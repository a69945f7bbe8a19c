#pragma once
// Options of the transport matrix.

#include <cstdint>

#include "solve/transport/transport_options.h"

namespace lumel {

struct MatrixOptions {
    std::uint32_t seed = 1;
    TransportOptions transport{
        .views = {.projection = Projection::hemicube, .hemicube = 256, .batch = 16},
        .patches = 2048,
        .bounces = 0};
};

}  // namespace lumel
