#pragma once
// A fingerprint of a scene.

#include <string>

#include "scene/values/scene.h"

namespace lumel {

/// 16 hex digits over all that decides the light: geometry, placement, materials, texture
/// contents, lights, sky. Names, cameras and the encoding of the file do not count.
std::string hash_scene(const Scene& scene);

}  // namespace lumel
