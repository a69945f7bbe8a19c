#pragma once
// What light does between the patches of a scene, whatever lights it [SF17]. See transport.cpp.

#include "solve/matrix/color_matrix.h"
#include "solve/transport/form_factors.h"
#include "solve/transport/lumel_rows.h"
#include "solve/transport/transport_options.h"
#include "solve/transport/voxel_patches.h"

namespace lumel {

/// What light does between the patches of a scene, whatever lights it.
struct Transport {
    VoxelPatches patches;
    SquareMatrix form_factors;  ///< [n][n], balanced
    FormFactorCheck check;
    /// [n][n] M = Σ_{h ≥ 1} (F^c)^h, Eq. (8), without the last bounce where they are limited
    ColorMatrix bounces;
    LumelRows rows;  ///< [N][n] of the last bounce

    /// H [N] [lx] of all reflections of direct light [N] [lx].
    std::vector<glm::vec3> indirect(const Lumels& lumels, std::span<const glm::vec3> direct) const;
};

/// Builds a Transport, a batch of shooters at a time.
class TransportBuilder {
public:
    /// All must outlive this. Form factors are made to add up, and patches to end at walls, as far
    /// as near.around shows.
    TransportBuilder(const gpu::Device& device, const World& world, const Lumels& lumels,
                     const NearField& near, const TransportOptions& options);

    bool done() const { return factors_.done(); }
    double fraction() const { return factors_.fraction(); }  ///< done, 0…1
    void step();
    /// Once done: balances, multiplies, fits. May be called once.
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
