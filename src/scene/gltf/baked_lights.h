#pragma once
// Lights of a glTF that a lightmap already holds: viewers are not to add them a second time, but a
// later bake or correction needs them.

#include "base/json/json_file.h"

namespace lumel {

/// Moves the lights and skies of a document, of its scenes and of its nodes from `extensions` to
/// `extras`, where no viewer looks. Returns how many lights nodes had.
std::size_t put_away_lights(Json& gltf);

/// Moves them back, unless there are none or a program has since given the document lists of its
/// own. `gltf` may be any JSON object.
void bring_back_lights(Json& gltf);

}  // namespace lumel
