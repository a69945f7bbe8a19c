#pragma once
// Precomputed light transport of a scene, for interactive relighting.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.

#include <cstdint>
#include <string>
#include <vector>

#include "scene/values/scene.h"
#include "solve/matrix/compressed.h"
#include "solve/transport/lumel_rows.h"
#include "solve/transport/voxel_patches.h"

namespace lumel {

/// Direct light of a source at the lumels.
struct SourceLight {
    std::string name;
    std::vector<std::string> materials;  ///< further names: its emissive materials
    std::vector<glm::vec3> direct;       ///< [N] lx
    /// [N] lx, all reflected light of surfaces, which cannot move; empty for lamps and sky, whose
    /// reflections are in the matrix
    std::vector<glm::vec3> reflected;
    std::vector<PunctualLight> lights;  ///< its movable lamps
};

/// H = Σ_s f_s (D_s + S_s) + R color (x + M x) for any factors f of the sources, D direct and S
/// reflected light of each, and x the patches' reflected_means() of Σ_s f_s D_s over those without
/// an S.
struct Relightable {
    std::string scene_hash;            ///< Scene::hash of the baked scene
    std::uint32_t side = 0;            ///< side of the atlas [texels]
    std::vector<std::uint32_t> place;  ///< [N] of lumels, see place_of()
    std::vector<float> area;           ///< [N] m², 0: buried
    std::vector<glm::vec3> albedo;     ///< [N]
    std::vector<SourceLight> sources;
    std::vector<Photometry> profiles;  ///< lamp profiles
    glm::dvec3 origin{0.0};            ///< as Scene::origin
    VoxelPatches patches;              ///< n of them; none if nothing reflects
    LumelRows rows;                    ///< [N][n] R
    CompressedMatrix matrix;           ///< [n][n] M

    std::size_t size() const { return place.size(); }  ///< N
};

/// Index of a lumel's texel and side.
constexpr std::uint32_t place_of(std::uint32_t texel, bool back)
{
    return 2 * texel + (back ? 1 : 0);
}

}  // namespace lumel
