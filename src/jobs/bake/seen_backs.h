#pragma once
// Finds surfaces whose wrong side is lit or seen: modelled inside out.

#include <string>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

/// A sentence on the object whose single-sided backs, which are black, take a large share of the
/// light of lamps and emissive surfaces, or of a camera's picture; empty if there is none.
std::string of_seen_backs(const SolveScene& prepared);

}  // namespace lumel
