#pragma once
// What would help a scene most, in a few sentences.

#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

/// At most three sentences for the user, each with what helps: on things that take most
/// of the lumels, on back sides, and on a sky that is far too dark beside the sun. Usual scenes get
/// none.
std::vector<std::string> advice(const SolveScene& prepared);

}  // namespace lumel
