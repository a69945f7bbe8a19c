#pragma once
// The light of a bake, corrected for an edited scene. See correction.cpp for the equations.

#include <optional>
#include <vector>

#include "bake/edited_scene.h"
#include "bake/stages.h"
#include "nearfield/hit_lumels.h"
#include "update/carried_light.h"

namespace lumel {

class Correction {
public:
    /// All must outlive this.
    Correction(const EditedScene& edit, const StoredSolution& solution, const BakeRecord& baked,
               Stages& stages);

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
    TwoEstimates gather(const std::vector<Asked>& asked, ChangedLightOptions options,
                        UpdateRow& row);
    CarriedLight carry(const std::vector<glm::vec3>& source, double error, UpdateRow& row);
    SentLight sent_before() const;
    SentLight sent_now() const;
    glm::vec3 unsent(std::size_t i, const glm::vec3& light, const SentLight& sent) const;

    const EditedScene& edit_;
    const BakeRecord& baked_;
    Stages& stages_;
    HitLumels hits_before_, hits_now_;
    std::vector<Asked> asked_;       ///< [N now]
    std::vector<glm::vec3> before_;  ///< H [N before]
    std::vector<glm::vec3> guess_;   ///< H~ [N now], but for D' - D
};

}  // namespace lumel
