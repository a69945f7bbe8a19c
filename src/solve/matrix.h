#pragma once
// Radiosity by a matrix of form factors of all reflections [SF17]. See matrix.cpp.

#include <optional>

#include "nearfield/solve_size.h"
#include "solve/stochastic.h"
#include "transport/transport.h"

namespace lumel {

/// How stochastic radiosity finds direct light beside the matrix.
StochasticOptions direct_options(const MatrixOptions& options);

/// Direct light by stochastic radiosity at full resolution, reflections by the matrix.
class MatrixRadiosity final : public Solver {
public:
    MatrixRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                    const NearField& near, const MatrixOptions& options,
                    std::span<const glm::vec3> known);

    /// Bytes on the device at most, on one whose images may be as large as is wanted.
    static std::uint64_t device_bytes(const SolveSize& size, const MatrixOptions& options);

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
