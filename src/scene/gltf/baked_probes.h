#pragma once
// Light probes in a baked glTF: nodes for engines to find. They are not part of the scene: later
// bakes and corrections omit them.

#include "base/json/json_file.h"

namespace lumel {

/// Appends the nodes `probes` to the default scene, as children of a node "light probes". No effect
/// without a scene. `gltf`: a bake's document.
void add_light_probes(Json& gltf, Json probes);

/// Removes the probes if they are still the last nodes. `gltf` may be any JSON object.
void drop_light_probes(Json& gltf);

}  // namespace lumel
