#pragma once
// A scene simplified to a few thousand patches, whatever its triangles.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Section 3.2.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/surroundings.h"
#include "raster/world/world.h"
#include "solve/matrix/elements.h"

namespace lumel {

/// Lumels that share a voxel and face alike.
struct VoxelPatch {
    float area = 0.0f;       ///< Σ A [m²]
    glm::vec3 centre{0.0f};  ///< mean place, in the world [m]
    glm::vec3 normal{0.0f};  ///< unit, mean, in the world
    glm::vec3 color{0.0f};   ///< mean albedo
};

inline constexpr std::uint32_t kPatchless = 0xffffffffu;  ///< of lumels that are buried

struct VoxelPatches {
    float side = 0.0f;                    ///< of a voxel [m]
    std::vector<std::uint32_t> patch_of;  ///< [N] or kPatchless
    std::vector<VoxelPatch> patches;      ///< [n]

    std::size_t size() const { return patches.size(); }
    /// Means over patches, by area, of what lumels have: [N] to [n].
    std::vector<glm::vec3> means(const Lumels& lumels, std::span<const glm::vec3> values) const;
    /// The light that would be reflected as much if it were the same all over each patch: means of
    /// irradiance by area and albedo, [N] to [n] [lx].
    std::vector<glm::vec3> reflected_means(const Lumels& lumels,
                                           std::span<const glm::vec3> irradiance) const;
    /// The same of lumels of which no more is known: area [N] [m²], albedo [N].
    std::vector<glm::vec3> reflected_means(std::span<const float> area,
                                           std::span<const glm::vec3> albedo,
                                           std::span<const glm::vec3> irradiance) const;
};

/// A lumel's place and unit normal in the world.
struct PlacedLumel {
    glm::vec3 position, normal;
};
PlacedLumel placed(const World& world, const Lumel& lumel);

/// Cuts charts by a grid of voxels, as fine as makes at most `most` patches, and where something
/// stands between lumels: light on one side of a wall is none on the other. What is smaller than a
/// voxel's face shares its patch with what lies in the same voxel and faces the same direction. The
/// same scene and number give the same patches. around: as far as it is known. Throws Error{input}
/// if fewer than two result, or no grid gives so few.
VoxelPatches make_voxel_patches(const World& world, const Lumels& lumels,
                                const Surroundings& around, std::uint32_t most);

/// What patches reflect [n] [lm/m²] of light that arrives straight from its sources and of light
/// that was reflected before, [n] [lx] each.
std::vector<glm::vec3> sent_by(const VoxelPatches& patches, std::span<const glm::vec3> direct,
                               std::span<const glm::vec3> reflected);

/// The patches as compressed forms of a matrix use them.
Elements elements_of(const VoxelPatches& patches);

}  // namespace lumel
