#pragma once
// The lit glTF.

#include <string>

#include "atlas/atlas.h"
#include "core/image.h"
#include "scene/scene.h"

namespace lumel {

/// scene.glb: the input file with every baked mesh given TEXCOORD_1 and the map bound by
/// MOZ_lightmap (in extensionsUsed, never extensionsRequired). `map`: irradiance [lx], RGBA,
/// stored as 8-bit linear PNG scaled to its brightest texel; intensity = that scale / π × …
/// (see gltf_write.cpp for the exact convention). Throws Error.
void write_scene_glb(const std::string& path, const Scene& scene, const Atlas& atlas, const Image& map);

/// scene-baked.glb: core glTF only (plus KHR_materials_emissive_strength as an option of the
/// viewer): each surface shows albedo × irradiance / π + its own emission as emissive texture on
/// TEXCOORD_1, with black base colour, so that any viewer shows it lit. `radiance`: RGBA map of
/// reflected plus emitted radiance [cd/m²].
void write_baked_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& radiance);

}  // namespace lumel
