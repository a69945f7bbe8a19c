#pragma once

#include <cstdint>

namespace lumel {

/// Where a LiveScene or a LeakyScene stands.
struct LiveState {
    /// Light still to be shot, as a part of all; of a LeakyScene the share of the light before the
    /// last change that is left.
    double residual = 1.0;
    bool under_way = false;       ///< a move is being redistributed
    bool at_rest = false;         ///< update() has nothing left to do
    std::uint64_t hemicubes = 0;  ///< so far; directions of a LeakyScene
    double milliseconds = 0.0;    ///< that the last update() took
};

}  // namespace lumel
