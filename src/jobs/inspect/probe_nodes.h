#pragma once
// Light probes as nodes in the glTF files of a bake.

#include <vector>

#include "jobs/inspect/probes.h"

namespace lumel {

/// Adds probes to the scene.glb and scene-baked.glb of a bake that is not yet committed. Throws
/// Error; one of the files can then have probes.
void write_probe_nodes(const OutputFolder& written, const std::vector<ProbeRow>& rows);

}  // namespace lumel
