#pragma once
// The light that an eye adapts to.

#include <vector>

#include "atlas/packing/atlas.h"

namespace lumel {

/// [N] The light to which an eye adapts that looks at each lumel: the mean of its chart or of its
/// neighbours, whichever is brighter, and at least kFaintest of the scene's mean. The lumel itself
/// has no part in that of its neighbours, so that its noise cannot hide itself. light: [N], summed
/// over channels [lx]. 0 for buried lumels.
std::vector<double> adapted_light(const Lumels& lumels, const std::vector<double>& light);

}  // namespace lumel
