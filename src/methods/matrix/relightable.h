#pragma once
// A scene's light as it answers at once to any change of its sources.
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

/// What a source sends straight to the lumels.
struct SourceLight {
    std::string name;
    std::vector<std::string> materials;  ///< further names: those that make it shine
    std::vector<glm::vec3> direct;       ///< [N] lx
    /// [N] lx, all that is reflected of it, of surfaces, which cannot move; empty: of lamps and
    /// sky, the matrix has it
    std::vector<glm::vec3> reflected;
    std::vector<PunctualLight> lights;  ///< its lamps, which may move
};

/// H = Σ_s f_s (D_s + S_s) + R color (x + M x) for any factors f of the sources, D direct and S
/// reflected light of each, and x the patches' reflected_means() of Σ_s f_s D_s over those without
/// an S.
struct Relightable {
    std::string scene_hash;            ///< Scene::hash of what was baked
    std::uint32_t side = 0;            ///< of the atlas [texels]
    std::vector<std::uint32_t> place;  ///< [N] of lumels, see place_of()
    std::vector<float> area;           ///< [N] m², 0: buried
    std::vector<glm::vec3> albedo;     ///< [N]
    std::vector<SourceLight> sources;
    std::vector<Photometry> profiles;  ///< of lamps
    glm::dvec3 origin{0.0};            ///< as Scene::origin
    VoxelPatches patches;              ///< n of them; none where nothing reflects
    LumelRows rows;                    ///< [N][n] R
    CompressedMatrix matrix;           ///< [n][n] M

    std::size_t size() const { return place.size(); }  ///< N
};

/// The place of a lumel of this texel and side.
constexpr std::uint32_t place_of(std::uint32_t texel, bool back)
{
    return 2 * texel + (back ? 1 : 0);
}

}  // namespace lumel
