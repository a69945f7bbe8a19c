#pragma once
// Options of the transport matrix.

#include <cstdint>

#include "solve/transport/transport.h"

namespace lumel {

struct MatrixOptions {
    std::uint32_t seed = 1;
    TransportOptions transport;
};

}  // namespace lumel
