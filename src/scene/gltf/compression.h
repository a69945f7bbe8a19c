#pragma once

namespace lumel {

/// Compression of the geometry of scene.glb.
enum class Compression {
    none,
    meshopt,  ///< EXT_meshopt_compression without loss, which the file then requires
};

}  // namespace lumel
