#pragma once
// Light probes in a baked glTF: nodes that engines find beside what they light. They are no part of
// the scene: a later bake, or a correction, leaves them out.

#include "base/json/json_file.h"

namespace lumel {

/// Appends a node called "light probes" to the default scene, and as its children `probes`, which
/// are nodes. Nothing where there is no scene to show them. `gltf`: as a bake has written it.
void add_light_probes(Json& gltf, Json probes);

/// Takes them out again, if they are still the last nodes. `gltf` may be any JSON object.
void drop_light_probes(Json& gltf);

}  // namespace lumel
