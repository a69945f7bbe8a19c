#pragma once
// Options of the transport matrix.

#include <cstdint>

#include "solve/transport/transport_options.h"

namespace lumel {

/// How the matrix of all reflections is stored for relighting.
enum class MatrixForm : std::uint8_t {
    tiles,  ///< TiledMatrix
    bc1,    ///< Bc1Matrix, the paper's
};

struct MatrixOptions {
    std::uint32_t seed = 1;
    TransportOptions transport{
        .views = {.projection = Projection::hemicube, .hemicube = 256, .batch = 16},
        .patches = 2048,
        .bounces = 0};
    MatrixForm form = MatrixForm::tiles;
};

}  // namespace lumel
