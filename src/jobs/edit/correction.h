#pragma once
// Corrects the light of a bake for an edited scene. Equations: correction.cpp.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "jobs/edit/edited_scene.h"
#include "jobs/edit/signed_light.h"

namespace lumel {

/// Progress callbacks of a correction.
struct CorrectionWatch {
    std::function<void(const char* stage)> begin;  ///< a stage begins
    /// Receives the fraction of the stage, 0…1, and the number of particles; false: stop.
    std::function<bool(double fraction, std::uint64_t particles)> follow;
};

class Correction {
public:
    /// All but `watch` must outlive this.
    Correction(const EditedScene& edit, const StoredSolution& solution, const BakeRecord& baked,
               CorrectionWatch watch);

    /// Change of emission, including reflected light of `lights`, D' - D [N] or empty, relative to
    /// all emitted light.
    double change(const std::vector<glm::vec3>& lights) const;

    /// H' [N] [lx] with an error of about `residual` relative to all light; empty if the change is
    /// too large. Fills the row's rays, particles and residual.
    std::optional<std::vector<glm::vec3>> correct(const std::vector<glm::vec3>& lights,
                                                  double residual, UpdateRow& row);

private:
    void look_first(UpdateRow& row);
    TwoEstimates gather_until(double residual, UpdateRow& row);
    TwoEstimates gather(const std::vector<Wanted>& wanted, ChangedLightOptions options,
                        UpdateRow& row);
    SignedLight carry(const std::vector<glm::vec3>& source, double error, UpdateRow& row);
    SentLight sent_before() const;
    SentLight sent_now() const;
    glm::vec3 unsent(std::size_t i, const glm::vec3& light, const SentLight& sent) const;

    const EditedScene& edit_;
    const BakeRecord& baked_;
    CorrectionWatch watch_;
    HitLumels hits_before_, hits_now_;
    std::vector<Wanted> wanted_;     ///< [N now]
    std::vector<glm::vec3> before_;  ///< H [N before]
    std::vector<glm::vec3> guess_;   ///< H~ [N now], without D' - D
};

}  // namespace lumel
