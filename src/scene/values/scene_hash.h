#pragma once
// Hash of a scene.

#include <string>

#include "scene/values/scene.h"

namespace lumel {

/// 16 hex digits over all content that affects light: geometry, placement, materials, texture
/// contents, lights, sky. Excludes names, cameras and the encoding of the file.
std::string hash_scene(const Scene& scene);

}  // namespace lumel
