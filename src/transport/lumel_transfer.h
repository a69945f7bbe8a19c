#pragma once
// From light on patches to light on lumels. See lumel_transfer.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "matrix/color_matrix.h"
#include "transport/voxel_patches.h"

namespace lumel {

/// A lumel takes its light from this number of patches.
inline constexpr std::size_t kTransferPatches = 8;

/// H_i = Σ_k weight_ik H_patch_ik.
struct LumelTransfer {
    std::vector<std::uint32_t> patch;  ///< [N][kTransferPatches], of weight 0: any
    std::vector<float> weight;         ///< [N][kTransferPatches]

    /// incident: [n] lx of the patches. Returns [N] lx.
    std::vector<glm::vec3> apply(std::span<const glm::vec3> incident) const;
};

/// Finds the weights, while form factors are found.
class LumelTransferFit {
public:
    /// `world`, `lumels` and `patches` are only read here.
    LumelTransferFit(const World& world, const Lumels& lumels, const VoxelPatches& patches);

    /// What lumels [N] and patches [n] receive of one patch if its radiosity is 1.
    void add(std::span<const float> lumels, std::span<const float> patches);

    /// form_factors: what was added, [n][n], patches in columns. sums [n]: what their rows add up
    /// to after balancing; closed [N]: lumels whose factors add up to 1.
    LumelTransfer fit(const SquareMatrix& form_factors, std::span<const float> sums,
                      std::span<const char> closed) const;

private:
    class Overlaps;

    void fit_lumel(std::size_t i, const Overlaps& overlaps, std::span<const float> sums,
                   bool closed, float* weights) const;

    std::size_t count_;                 ///< N
    std::vector<std::uint32_t> patch_;  ///< [N][kTransferPatches]
    std::vector<float> start_;          ///< [N][kTransferPatches] weights by distance, Σ = 1
    std::vector<float> products_;       ///< [N][kTransferPatches] Σ_p F_ip F_qp
    std::vector<float> received_;       ///< [N] Σ_p F_ip
};

}  // namespace lumel
