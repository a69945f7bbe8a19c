#pragma once
// Options of the transport matrix.

#include <cstdint>

#include "solve/transport/transport.h"

namespace lumel {

/// How the matrix of all reflections is stored for relighting.
enum class MatrixForm : std::uint8_t {
    tiles,  ///< TiledMatrix
    bc1,    ///< Bc1Matrix, the paper's
};

struct MatrixOptions {
    std::uint32_t seed = 1;
    TransportOptions transport;
    MatrixForm form = MatrixForm::tiles;
};

}  // namespace lumel
