#pragma once
// Writes the lit glTF: the scene's document with a lightmap, or with its light baked in.
//
// Both files are one self-contained .glb. All of the input's content is kept (nodes, cameras,
// animations, skins, extras, images), but every baked primitive of every instance becomes a
// separate triangle list with TEXCOORD_1 = atlas coordinates, (0, 0) at the top left. Materials
// that use the old TEXCOORD_1 for their own textures get it as TEXCOORD_0, or as the next free
// number if that is used too.

#include <optional>
#include <span>
#include <string>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "base/images/lightmap_format.h"
#include "results/files/lamps_in_scene.h"
#include "scene/gltf/compression.h"
#include "scene/gltf/document.h"
#include "scene/values/scene.h"
#include "scene/values/view.h"

namespace lumel {

/// A camera for a scene that has none.
struct AddedCamera {
    View view;     ///< perspective
    float extent;  ///< diagonal of the scene [m]
};

/// Light properties for scene.glb.
struct SceneLighting {
    bool keep = false;              ///< keeps lamps and skies of the input
    std::optional<float> exposure;  ///< exposure for the scene [1/lx]
    LightmapFormat format = LightmapFormat::ktx2;
    Compression compression = Compression::none;
    std::optional<AddedCamera> camera;
    std::span<const SceneLamp> lamps = {};  ///< whose light is kept apart; not for format none
};

/// scene.glb: the map is bound by MOZ_lightmap {index, texCoord: 1, intensity} on every baked
/// material; the extension is listed in extensionsUsed only, so that a viewer without it shows the
/// scene unlit. Texels hold irradiance / intensity. The texture has two images: a KTX2 without
/// clipping, bound by KHR_texture_basisu, and for loaders without it an 8-bit linear PNG. intensity
/// [lx] is the brightest covered texel, but at most what the exposure shows nearly white;
/// the PNG clips there. As in three.js, the radiance that a surface reflects is
///     albedo / π × texel × intensity.
/// extras.lumel of each baked material also names the map beside the file: tools that drop the
/// extension keep extras. document: that the scene was read from. map: irradiance [lx], RGBA.
/// Throws Error.
///
/// Maps of lamps are added as add_lamps() does.
///
/// Lamps and skies of the input are baked: they move to extras (see scene/gltf/baked_lights.h),
/// unless `lights` keeps them. asset.extras.lumel has their number and the exposure. A camera of
/// `lights` is added as the node "preview" of the default scene.
void write_scene_glb(const std::string& path, const GltfDocument& document, const Scene& scene,
                     const Atlas& atlas, const Image& map, const SceneLighting& lights = {});

/// scene-baked.glb: core glTF that any viewer shows lit. Every baked material is black, fully
/// metallic and rough, so that it reflects nothing, and emits an 8-bit sRGB texture on TEXCOORD_1.
/// Cut-outs and blending keep their alpha. Lights, material extensions and vertex attributes that
/// nothing reads are removed. shown: light from surfaces, tone-mapped by tone_map, RGBA, of any
/// density. camera: added as in scene.glb. Throws Error.
void write_baked_glb(const std::string& path, const GltfDocument& document, const Scene& scene,
                     const Atlas& atlas, const Image& shown,
                     const std::optional<AddedCamera>& camera = {});

}  // namespace lumel
