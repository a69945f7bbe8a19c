#pragma once
// Radiosity by a matrix of form factors of all reflections [SF17]. See matrix.cpp.

#include <optional>

#include "links/trace/final_gather.h"
#include "methods/matrix/options.h"
#include "solve/solver/inputs.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"
#include "solve/transport/transport.h"

namespace lumel {

/// Direct light by shadow rays, at full resolution; reflections by the matrix.
class MatrixRadiosity final : public Solver {
public:
    /// All arguments must outlive this. target_error: of direct light. known: SolverInputs::known.
    MatrixRadiosity(const gpu::Device& device, const World& world, const SolveScene& scene,
                    const Lumels& lumels, const NearField& near, const MatrixOptions& options,
                    double target_error, std::span<const glm::vec3> known);

    /// Upper bound on GPU memory [bytes], if the device does not limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const MatrixOptions& options);

    void step() override;
    /// The error is that of direct light.
    SolverState state() const override;
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return longest_; }
    std::string rays() const override { return "host"; }

    /// Null until the form factors are found, or if nothing reflects.
    const Transport* transport() const { return transport_ ? &*transport_ : nullptr; }

private:
    const Lumels* lumels_;
    std::vector<glm::vec3> known_;  ///< [N] [lx]
    std::optional<TransportBuilder> builder_;
    std::optional<Transport> transport_;
    DirectRays direct_;
    std::uint32_t seed_, gather_rays_;
    gpu::StageTimes times_;
    double longest_ = 0.0;
};

}  // namespace lumel
