#pragma once
// The lit glTF: the input file with a lightmap, or with its light baked in.
//
// Both files are one self-contained .glb. All of the input's content stays (nodes, cameras,
// animations, skins, extras, images), but every baked primitive of every instance becomes a
// triangle list of its own with TEXCOORD_1 = its place in the atlas, (0, 0) at the top left.
// Materials that read their own textures through the old TEXCOORD_1 find it under TEXCOORD_0, or
// under the next free number where that is read too.

#include <optional>
#include <string>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "base/images/lightmap_format.h"
#include "scene/values/scene.h"

namespace lumel {

/// What scene.glb says of light.
struct SceneLighting {
    bool keep = false;              ///< lamps and skies of the input
    std::optional<float> exposure;  ///< that suits the scene [1/lx]
    LightmapFormat format = LightmapFormat::ktx2;
};

/// scene.glb: the map is bound by MOZ_lightmap {index, texCoord: 1, intensity} on every baked
/// material; the extension is listed in extensionsUsed only, so that a viewer without it shows
/// the scene unlit. Texels hold irradiance / intensity. The texture has two images: a KTX2 that
/// clips nothing, bound by KHR_texture_basisu, and for loaders without it an 8-bit linear PNG.
/// intensity [lx] is the brightest covered texel, but at most what the exposure shows white; there
/// the PNG clips. As in three.js, the radiance that a surface reflects is
///     albedo / π × texel × intensity.
/// extras.lumel of each baked material names the map that stands beside the file too: tools that
/// drop the extension keep extras. `map`: irradiance [lx], RGBA. Throws Error.
///
/// Lamps and skies of the input are baked: they go to extras (see scene/gltf/baked_lights.h),
/// unless `lights` keeps them. asset.extras.lumel says how many, and has the exposure.
void write_scene_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& map, const SceneLighting& lights = {});

/// scene-baked.glb: core glTF that any viewer shows lit. Every baked material is black, fully
/// metallic and rough, so that it reflects nothing, and emits a texture on TEXCOORD_1, 8
/// bits, sRGB. Cut-outs and blending keep their alpha. Lights and material extensions are left
/// out: the light is in the colours. `shown`: what surfaces send, as tone_map shows it, RGBA, of
/// any density. Throws Error.
void write_baked_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& shown);

}  // namespace lumel
