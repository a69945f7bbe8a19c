#pragma once
// The scenes of [Hoef13] section 5.1, ready for their moves.

#include <vector>

#include "bench/papers/figures.h"
#include "bench/papers/moving.h"

namespace lumel::bench {

/// One scene, the places of its box and how it is laid out.
struct Stage {
    Scene scene;
    std::uint32_t box = 0;
    std::vector<glm::mat4> places;  ///< one after another
    LiveOptions options;
    GatherOptions gather;
};

/// pieces: that edges are cut into.
Stage set(const ThesisScene& which, const DynamicSettings& settings, int pieces);

/// With the box in its last place.
Scene posed(const Stage& stage);

/// Those that the settings ask for.
std::vector<ThesisScene> scenes_of(const DynamicSettings& settings);

}  // namespace lumel::bench
