#pragma once
// Radiosity by global directions, but for the light of emissive surfaces, which rays to points on
// them find. See directions_radiosity.cpp.

#include <optional>

#include "links/direct/direct_rays.h"
#include "methods/directions/directions.h"
#include "solve/solver/inputs.h"

namespace lumel {

/// Direct light by rays to its sources, reflections along global directions.
class DirectionsRadiosity final : public Solver {
public:
    /// What is given must outlive it. known: as make_solver takes it. Returns `parts` of the light
    /// that it finds.
    DirectionsRadiosity(const gpu::Device& device, const World& world, const HostScene& host,
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
    double direct_error_;           ///< that direct light is to have
    std::vector<glm::vec3> known_;  ///< [N] [lx]
    Lumels reflecting_;             ///< shine with what they reflect of direct light
    DirectRays direct_;
    std::optional<GlobalDirections> directions_;
    bool reflects_;
    gpu::StageTimes none_;
};

}  // namespace lumel
