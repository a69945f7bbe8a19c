#pragma once
// What textures lose where they are drawn at the density of the lightmap.

#include <string>

#include "atlas/atlas.h"
#include "scene/scene.h"

namespace lumel {

/// A sentence that says how many textures scene-baked.glb, which has the lightmap's density, shows
/// more coarsely than they are; empty if none.
std::string lost_grain(const Scene& scene, const Atlas& atlas);

}  // namespace lumel
