#pragma once

#include <cstdint>

namespace lumel {

/// Status of a LiveScene or a LeakyScene.
struct LiveState {
    /// Unshot light relative to all light; in a LeakyScene, remaining fraction of the light before
    /// the last change.
    double residual = 1.0;
    bool under_way = false;       ///< a move is being redistributed
    bool at_rest = false;         ///< update() has no work left
    std::uint64_t hemicubes = 0;  ///< total; a LeakyScene counts directions
    double milliseconds = 0.0;    ///< duration of the last update()
};

}  // namespace lumel
