#pragma once
// Light probes as nodes of the glTF files that a bake has written.

#include <string>

#include "bake/probes.h"

namespace lumel {

/// Puts probes into scene.glb and scene-baked.glb of a folder, both or none. Throws Error.
void write_probe_nodes(const std::string& folder, const ProbesSummary& probes);

}  // namespace lumel
