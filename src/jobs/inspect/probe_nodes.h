#pragma once
// Light probes as nodes of the glTF files that a bake has written.

#include <vector>

#include "jobs/inspect/probes.h"

namespace lumel {

/// Puts probes into the scene.glb and scene-baked.glb that a bake has written and not yet
/// committed. Throws Error; then one of them may have probes.
void write_probe_nodes(const OutputFolder& written, const std::vector<ProbeRow>& rows);

}  // namespace lumel
