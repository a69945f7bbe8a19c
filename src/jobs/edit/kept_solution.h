#pragma once
// Bakes with links stored for later runs.

#include <memory>
#include <optional>

#include "jobs/edit/edited_scene.h"
#include "jobs/solve/lighting.h"
#include "links/live/link_relighter.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Throws Error{input} if the bake's options cannot be met with stored links.
void check_keep_links(const BakeOptions& options);

/// Options for tracing and lighting `rays` links per lumel.
KeptLightOptions kept_light_options(std::uint32_t rays, const LinksOptions& links);

/// Stored links renumbered for the scene after an edit.
StoredLinks links_for(const EditedScene& edit, const StoredLinks& before);

/// Light over stored links, with the interface of a finished method.
class KeptLinksSolver final : public Solver {
public:
    /// Traces links, or reuses valid ones of `kept`, in the stage "links", and lights them in the
    /// stage "solving". All arguments must outlive this. Throws Error{stopped} if the caller stops
    /// it.
    KeptLinksSolver(const SolveScene& prepared, const KeptLightOptions& options, Stages& stages,
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
    gpu::StageTimes times_;              ///< none: runs on the CPU
};

/// Solves with options.keep_links rays per lumel, and stores the links in Solution::links.
std::unique_ptr<Solution> solve_over_kept_links(const Setting& setting, const BakeOptions& options,
                                                Stages& stages);

}  // namespace lumel
