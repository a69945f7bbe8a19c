#pragma once
// A bake over links that are kept for later runs.

#include <memory>
#include <optional>

#include "jobs/edit/edited_scene.h"
#include "jobs/solve/lighting.h"
#include "links/live/link_relighter.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Throws Error{input} where a bake asks for what links that are kept cannot.
void check_keep_links(const BakeOptions& options);

/// How `rays` of each lumel are traced and lit for the options of links.
KeptLightOptions kept_light_options(std::uint32_t rays, const LinksOptions& links);

/// Links of the scene before an edit, for the scene now.
StoredLinks links_for(const EditedScene& edit, const StoredLinks& before);

/// Light over kept links, as a method that has run.
class KeptLinksSolver final : public Solver {
public:
    /// Traces links, or takes over those of `kept` that still hold, in the stage "links", and
    /// lights them in the stage "solving". What is given must outlive it. Throws Error{stopped}
    /// where the caller wants to stop.
    KeptLinksSolver(const Prepared& prepared, const KeptLightOptions& options, Stages& stages,
                    const StoredLinks* kept = nullptr);

    void step() override {}
    SolverState state() const override;
    std::vector<glm::vec3> irradiance() override { return irradiance_; }
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return 0.0; }
    std::string rays() const override { return "host"; }

    const LinkRelighter& light() const { return *light_; }

private:
    std::optional<LinkRelighter> light_;
    std::vector<glm::vec3> irradiance_;  ///< [N] [lx]
    gpu::StageTimes times_;              ///< none: it works on the host
};

/// Solves by options.keep_links rays of each lumel, and leaves them in Solution::links.
std::unique_ptr<Solution> solve_over_kept_links(const Setting& setting, const BakeOptions& options,
                                                Stages& stages);

}  // namespace lumel
