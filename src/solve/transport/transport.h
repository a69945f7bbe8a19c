#pragma once
// Light transport between patches, independent of the light sources [SF17]. See transport.cpp.

#include "solve/matrix/color_matrix.h"
#include "solve/transport/form_factors.h"
#include "solve/transport/lumel_rows.h"
#include "solve/transport/transport_options.h"
#include "solve/transport/voxel_patches.h"

namespace lumel {

/// Light transport between the patches of a scene, independent of the light sources.
struct Transport {
    VoxelPatches patches;
    SquareMatrix form_factors;  ///< [n][n], balanced
    FormFactorCheck check;
    /// [n][n] M = Σ_{h ≥ 1} (F^c)^h, Eq. (8), without the last bounce if bounces are limited
    ColorMatrix bounces;
    LumelRows rows;  ///< [N][n] of the last bounce

    /// All reflected light H [N] [lx] of direct light [N] [lx].
    std::vector<glm::vec3> indirect(const Lumels& lumels, std::span<const glm::vec3> direct) const;
};

/// Builds a Transport in batches of shooters.
class TransportBuilder {
public:
    /// All arguments must outlive this. Uses near.around, where known, to close rows and to split
    /// patches at walls.
    TransportBuilder(const gpu::Device& device, const World& world, const Lumels& lumels,
                     const NearField& near, const TransportOptions& options);

    bool done() const { return factors_.done(); }
    double fraction() const { return factors_.fraction(); }  ///< 0…1
    void step();
    /// Balances, multiplies and fits. Requires done(). Call once.
    Transport finish();

    const FormFactors& factors() const { return factors_; }

private:
    const Lumels* lumels_;
    Surroundings around_;
    std::uint32_t bounces_;
    VoxelPatches patches_;
    FormFactors factors_;
    LumelRowsBuilder rows_;
};

}  // namespace lumel
