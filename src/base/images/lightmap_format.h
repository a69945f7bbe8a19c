#pragma once

namespace lumel {

/// Lightmap format of scene.glb.
enum class LightmapFormat {
    ktx2,    ///< half floats in KTX2, and a PNG for loaders that do not read it
    rgb9e5,  ///< three mantissas and a shared exponent in KTX2, and the PNG
    png,     ///< the PNG alone: 8 bits, linear, bright texels clipped
    none,    ///< no lightmap inside; lightmap.exr beside it is the map
};

}  // namespace lumel
