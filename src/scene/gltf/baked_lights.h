#pragma once
// Lights of a glTF that are part of its lightmap. Viewers must not add them again, but later bakes
// and corrections need them.

#include "base/json/json_file.h"

namespace lumel {

/// Hides the lights and skies of a document, its scenes and its nodes: moves them from `extensions`
/// to `extras`, which viewers ignore. Returns the number of node lights.
std::size_t put_away_lights(Json& gltf);

/// Restores hidden lights, unless the document has new lists of lights. `gltf` may be any JSON
/// object.
void bring_back_lights(Json& gltf);

}  // namespace lumel
