#pragma once
// The image-based light of a glTF scene.

#include "scene/gltf/document.h"
#include "scene/values/sky.h"

namespace lumel {

/// The light of EXT_lights_image_based in the default scene; empty without one. The sharpest cube
/// is radiance [cd/m²] times the extension's intensity; PNG with alpha is RGBD. Throws
/// Error{input}.
Sky read_image_based_light(const GltfDocument& document);

}  // namespace lumel
