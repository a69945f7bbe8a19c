#pragma once
// lumel relight over links stored by lumel bake --keep-links.

#include <string>

#include "jobs/relight/relight.h"
#include "jobs/solve/stages.h"

namespace lumel {

/// True if a folder has scene.lumellinks.
bool keeps_links(const std::string& folder);

/// relight() by recomputed direct light of each state and sweeps over the links. Throws Error.
RelightSummary relight_over_links(const std::string& folder, const std::string& states,
                                  Stages& stages);

}  // namespace lumel
