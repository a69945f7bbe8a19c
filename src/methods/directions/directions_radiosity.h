#pragma once
// Radiosity by global directions, with direct light of emissive surfaces by shadow rays. See
// directions_radiosity.cpp.

#include <optional>

#include "links/direct/direct_rays.h"
#include "methods/directions/directions.h"
#include "solve/solver/inputs.h"

namespace lumel {

/// Direct light by shadow rays, reflections along global directions.
class DirectionsRadiosity final : public Solver {
public:
    /// All arguments must outlive this. known: SolverInputs::known. irradiance() returns `parts` of
    /// the light.
    DirectionsRadiosity(const gpu::Device& device, const World& world, const SolveScene& scene,
                        const Lumels& lumels, const DirectionsOptions& options, double target_error,
                        std::span<const glm::vec3> known, Parts parts);

    void step() override;
    SolverState state() const override;
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override;
    double longest_submission() const override;
    std::string rays() const override { return "host"; }

private:
    void begin_directions();

    const gpu::Device* device_;
    const World* world_;
    DirectionsOptions options_;
    Parts parts_;
    double direct_error_;           ///< target error of direct light
    std::vector<glm::vec3> known_;  ///< [N] [lx]
    Lumels reflecting_;             ///< emit the light that they reflect of direct light
    DirectRays direct_;
    std::optional<GlobalDirections> directions_;
    bool reflects_;
    gpu::StageTimes none_;
};

}  // namespace lumel
