#pragma once
// Radiosity by a matrix of form factors of all reflections [SF17]. See matrix.cpp.

#include <optional>

#include "solve/form_factors.h"
#include "solve/lumel_transfer.h"
#include "solve/stochastic.h"

namespace lumel {

/// What light does between the patches of a scene, whatever lights it.
struct Transport {
    VoxelPatches patches;
    SquareMatrix form_factors;  ///< [n][n], balanced
    FormFactorCheck check;
    ColorMatrix bounces;  ///< [n][n] Σ_{h ≥ 1} (F^c)^h, Eq. (8)
    LumelTransfer transfer;

    /// H [N] [lx] that reflections bring, of direct light [N] [lx].
    std::vector<glm::vec3> indirect(const Lumels& lumels, std::span<const glm::vec3> direct) const;
};

/// Builds a Transport, a batch of shooters at a time.
class TransportBuilder {
public:
    /// All must outlive this. Form factors are made to add up, and
    /// patches to end at walls, as far as near.around knows.
    TransportBuilder(const gpu::Device& device, const World& world, const Lumels& lumels,
                     const NearField& near, const SolverOptions& options);

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
    LumelTransferFit fit_;
};

/// Direct light by stochastic radiosity at full resolution, reflections by the matrix.
class MatrixRadiosity final : public Solver {
public:
    MatrixRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                    const NearField& near, const SolverOptions& options,
                    std::span<const glm::vec3> known);

    /// Bytes on the device at most, on one whose images may be as large as is wanted.
    static std::uint64_t device_bytes(const SolveSize& size, const SolverOptions& options);

    void step() override;
    /// The error is that of direct light.
    SolverState state() const override;
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override;

    /// Null until the form factors are found, or if nothing reflects.
    const Transport* transport() const { return transport_ ? &*transport_ : nullptr; }

private:
    const Lumels* lumels_;
    Lumels black_;  ///< shine, but reflect nothing
    std::optional<TransportBuilder> builder_;
    std::optional<Transport> transport_;
    StochasticRadiosity direct_;
    gpu::StageTimes factor_times_, times_;
    double longest_ = 0.0;
};

}  // namespace lumel
