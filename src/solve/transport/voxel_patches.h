#pragma once
// Simplifies a scene to a few thousand patches, independent of its triangles.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Section 3.2.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/surroundings.h"
#include "raster/world/world.h"
#include "solve/matrix/elements.h"

namespace lumel {

/// Lumels in one voxel that face the same way.
struct VoxelPatch {
    float area = 0.0f;       ///< Σ A [m²]
    glm::vec3 centre{0.0f};  ///< mean position, world space [m]
    glm::vec3 normal{0.0f};  ///< mean unit normal, world space
    glm::vec3 color{0.0f};   ///< mean albedo
};

inline constexpr std::uint32_t kPatchless = 0xffffffffu;  ///< patch of buried lumels

struct VoxelPatches {
    float side = 0.0f;                    ///< side of a voxel [m]
    std::vector<std::uint32_t> patch_of;  ///< [N] or kPatchless
    std::vector<VoxelPatch> patches;      ///< [n]

    std::size_t size() const { return patches.size(); }
    /// Area-weighted means over patches of lumel values: [N] to [n].
    std::vector<glm::vec3> means(const Lumels& lumels, std::span<const glm::vec3> values) const;
    /// Irradiance [n] [lx] that, if uniform over each patch, reflects the same light: mean of
    /// irradiance [N] weighted by area and albedo.
    std::vector<glm::vec3> reflected_means(const Lumels& lumels,
                                           std::span<const glm::vec3> irradiance) const;
    /// Overload for lumels given by area [N] [m²] and albedo [N].
    std::vector<glm::vec3> reflected_means(std::span<const float> area,
                                           std::span<const glm::vec3> albedo,
                                           std::span<const glm::vec3> irradiance) const;
};

/// Position and unit normal of a lumel in world space.
struct PlacedLumel {
    glm::vec3 position, normal;
};
PlacedLumel placed(const World& world, const Lumel& lumel);

/// Cuts charts by the finest voxel grid that makes at most `most` patches, and at walls between
/// lumels, so that light does not leak through them. Geometry smaller than a voxel's face shares
/// its patch with lumels in the same voxel that face the same direction. Deterministic. around: may
/// be incomplete. Throws Error{input} if fewer than two patches result, or if no grid makes so few.
VoxelPatches make_voxel_patches(const World& world, const Lumels& lumels,
                                const Surroundings& around, std::uint32_t most);

/// Radiosity of patches [n] [lm/m²] from their direct and reflected irradiance, [n] [lx] each.
std::vector<glm::vec3> sent_by(const VoxelPatches& patches, std::span<const glm::vec3> direct,
                               std::span<const glm::vec3> reflected);

/// Attributes of the patches for compressed forms of a matrix.
Elements elements_of(const VoxelPatches& patches);

}  // namespace lumel
