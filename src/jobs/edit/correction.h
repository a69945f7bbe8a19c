#pragma once
// The light of a bake, corrected for an edited scene. See correction.cpp for the equations.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "jobs/edit/edited_scene.h"
#include "jobs/edit/signed_light.h"

namespace lumel {

/// Who follows a correction.
struct CorrectionWatch {
    std::function<void(const char* stage)> begin;  ///< a stage begins
    /// How far the stage is, 0…1, and particles so far; false: it is to stop.
    std::function<bool(double fraction, std::uint64_t particles)> follow;
};

class Correction {
public:
    /// All but `watch` must outlive this.
    Correction(const EditedScene& edit, const StoredSolution& solution, const BakeRecord& baked,
               CorrectionWatch watch);

    /// Emission that came, went or changed, and what is reflected otherwise of `lights`, D' - D [N]
    /// or empty, as a part of all that is sent.
    double change(const std::vector<glm::vec3>& lights) const;

    /// H' [N] [lx] with an error of about `residual`, a part of all light; nothing if too much
    /// changed to be carried. Fills the row's rays, particles and residual.
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
    std::vector<glm::vec3> guess_;   ///< H~ [N now], but for D' - D
};

}  // namespace lumel
