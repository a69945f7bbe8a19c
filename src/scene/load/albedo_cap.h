#pragma once
// The maximum reflectance of materials.

#include "scene/values/scene.h"

namespace lumel {

/// Limits the reflected light of all materials to `most` [0…1] of the brightest channel, see
/// MaterialSample; 1: the file's. One warning names the materials that the limit darkens as a
/// whole. Updates the hash only if the limit changes. Colours of the scene stay as they are.
void cap_albedo(Scene& scene, float most);

}  // namespace lumel
