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

#include "atlas/atlas.h"
#include "core/image.h"
#include "scene/scene.h"

namespace lumel {

/// What scene.glb says of light.
struct SceneLights {
    bool keep = false;              ///< lamps and skies of the input
    std::optional<float> exposure;  ///< that suits the map [1/lx]
};

/// scene.glb: the map is bound by MOZ_lightmap {index, texCoord: 1, intensity} on every baked
/// material; the extension is listed in extensionsUsed only, so that a viewer without it shows
/// the scene unlit. The PNG holds irradiance / intensity, 8 bits, linear; intensity [lx] is the
/// brightest covered texel, but at most twice the map's bright end (see bright_end), beyond which
/// the PNG clips. As in three.js, the radiance that a surface reflects is
///     albedo / π × texel × intensity.
/// `map`: irradiance [lx], RGBA. Throws Error.
///
/// Lamps and skies of the input are baked: they go to extras (see scene/baked_lights.h), unless
/// `lights` keeps them. asset.extras.lumel says how many, and has the exposure.
void write_scene_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& map, const SceneLights& lights = {});

/// scene-baked.glb: core glTF that any viewer shows lit. Every baked material is black, fully
/// metallic and rough, so that it reflects nothing, and emits a texture on TEXCOORD_1: the
/// radiance map under tone_map's exposure and curve, 8 bits, sRGB. Cut-outs and blending keep
/// their alpha. Lights and material extensions are left out: the light is in the colours.
/// `radiance`: reflected plus emitted [cd/m²], RGBA. Throws Error.
void write_baked_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& radiance);

}  // namespace lumel
