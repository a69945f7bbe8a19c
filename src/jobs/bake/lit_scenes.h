#pragma once
// Contents of scene.glb and scene-baked.glb.

#include <optional>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "results/files/gltf_write.h"

namespace lumel {

/// Reflected plus emitted radiance L = (ρ H + E) / π of every lumel [cd/m²]. irradiance [N] [lx].
std::vector<glm::vec3> radiance_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance);

/// Exposure of light without a preview [m²/cd].
float exposure_of(const Image& radiance);

/// The camera that `view` shows, for a scene without one. view: empty if there is none.
std::optional<AddedCamera> camera_for(const SolveScene& prepared, const std::optional<View>& view);

/// The texture of scene-baked.glb.
struct BakedTexture {
    Image radiance;  ///< [cd/m²]
    double density;  ///< relative to that of the scene's own textures, at most 1
};

/// As dense as the scene's own textures, but of at most `most` texels a side. map: irradiance [lx],
/// radiance: of the finished map [cd/m²].
BakedTexture baked_texture(const SolveScene& prepared, const Image& map, const Image& radiance,
                           int most);

}  // namespace lumel
