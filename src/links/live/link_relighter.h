#pragma once
// Relights a static scene over links that can be stored for a later run.

#include <optional>
#include <vector>

#include "links/live/display_filter.h"
#include "links/live/kept_error.h"
#include "links/live/light_groups.h"
#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

struct KeptLightOptions {
    std::uint32_t rays = 64;  ///< per lumel: 4, 16, 64 or 256
    std::uint32_t seed = 0;
    /// Direct light. Many rays: results are baked.
    GroupedLightOptions light = {.few_rays = 8, .many_rays = 64};
    /// Convergence threshold for the relative residual of all lumels and of dark ones.
    double residual = 2e-4;
    bool filter = true;  ///< filters light by rays, see links/live/display_filter.h
};

/// Traces links, or reuses stored ones that are still valid, and lights the scene over them each
/// time that lamps, sky or emission change. For equal scene, options and seed the light is equal
/// bit for bit, whether links were traced or reused, and whatever was lit before. Runs on the CPU.
class LinkRelighter {
public:
    /// The scene must outlive this; its lights, sky and emission may change. kept: links of an
    /// earlier run, or null. Throws Error{input} for coloured glass.
    LinkRelighter(const SolveScene& scene, const KeptLightOptions& options,
                  const StoredLinks* kept = nullptr, const ProgressCallback& progress = {});
    LinkRelighter(const LinkRelighter&) = delete;
    LinkRelighter& operator=(const LinkRelighter&) = delete;

    /// H [N] [lx] of the scene as it is now.
    std::vector<glm::vec3> irradiance(const ProgressCallback& progress = {});

    /// Error estimate of the last light.
    const KeptError& error() const { return error_; }
    const LumelLinks& links() const { return links_; }
    int sweeps() const { return sweeps_ ? sweeps_->sweeps() : 0; }  ///< for the last light
    /// Links to store for a later run. hash: Scene::hash.
    StoredLinks kept(const std::string& hash) const;

private:
    LinkContext place() const;
    void find_sources();
    std::vector<glm::vec3> light_of_lamps(std::vector<glm::vec3>& off,
                                          const ProgressCallback& progress);
    void settle(const ProgressCallback& progress);
    void make_weights(DisplayFilter& filter, const ProgressCallback& progress);

    const SolveScene& scene_;
    const KeptLightOptions options_;
    DynamicRayScene rays_;
    std::optional<Surfaces> surfaces_;  ///< with the current emission
    WorldLumels world_;
    RayOrigins starts_;
    std::optional<LightSources> sources_;
    LumelLinks links_;
    std::optional<LumelSweeps> sweeps_;
    KeptError error_;
};

}  // namespace lumel
