#pragma once
// lumel relight over links that lumel bake --keep-links kept.

#include <string>

#include "jobs/relight/relight.h"
#include "jobs/solve/stages.h"

namespace lumel {

/// Does a folder have scene.lumellinks?
bool keeps_links(const std::string& folder);

/// What relight() does: direct light of each state anew, and sweeps over the links. Throws Error.
RelightSummary relight_over_links(const std::string& folder, const std::string& states,
                                  Stages& stages);

}  // namespace lumel
