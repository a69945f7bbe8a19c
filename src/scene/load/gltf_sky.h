#pragma once
// The image-based light of a glTF scene.

#include "scene/gltf/document.h"
#include "scene/values/sky.h"

namespace lumel {

/// The light that EXT_lights_image_based gives the default scene; empty without one. Its sharpest
/// cube of images is taken as radiance [cd/m²] times its intensity; PNG with alpha as RGBD.
/// Throws Error{input}.
Sky read_image_based_light(const GltfDocument& document);

}  // namespace lumel
