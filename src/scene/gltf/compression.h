#pragma once

namespace lumel {

/// Compression of the geometry of scene.glb.
enum class Compression {
    none,
    meshopt,  ///< EXT_meshopt_compression without loss, which the file then requires
    draco,    ///< KHR_draco_mesh_compression with rounded vertices, which the file then requires
};

}  // namespace lumel
