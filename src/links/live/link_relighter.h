#pragma once
// The light of a scene that stands still, over links that are kept for a later run.

#include <optional>
#include <vector>

#include "links/live/display_filter.h"
#include "links/live/kept_error.h"
#include "links/live/light_groups.h"
#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

struct KeptLightOptions {
    std::uint32_t rays = 64;  ///< of a lumel: 4, 16, 64 or 256
    std::uint32_t seed = 0;
    /// Of direct light; many: as what is baked is looked at for long.
    GroupedLightOptions light = {.few_rays = 8, .many_rays = 64};
    /// Light still to come, as a part of all and of dark lumels' own, to rest at.
    double residual = 2e-4;
    bool filter = true;  ///< of what rays bring, see links/live/display_filter.h
};

/// Traces links, or takes over those that still hold; lights them as often as lamps, sky and what
/// surfaces send change. The same scene, options and seed have the same light in every bit, whether
/// links were traced or taken over, and whatever was lit before. Works on the host.
class LinkRelighter {
public:
    /// What is given must outlive it; of the scene lights, sky and what materials send may change.
    /// kept: links of a former run, or null. Throws Error{input} for coloured glass.
    LinkRelighter(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                  const KeptLightOptions& options, const StoredLinks* kept = nullptr,
                  const ProgressCallback& progress = {});
    LinkRelighter(const LinkRelighter&) = delete;
    LinkRelighter& operator=(const LinkRelighter&) = delete;

    /// Finds the light of the scene as it is now: H [N] [lx].
    std::vector<glm::vec3> irradiance(const ProgressCallback& progress = {});

    /// Of the last light.
    const KeptError& error() const { return error_; }
    const LumelLinks& links() const { return links_; }
    int sweeps() const { return sweeps_ ? sweeps_->sweeps() : 0; }  ///< of the last light
    /// For a later run. hash: Scene::hash.
    StoredLinks kept(const std::string& hash) const;

private:
    LinkContext place() const;
    void find_sources();
    std::vector<glm::vec3> light_of_lamps(std::vector<glm::vec3>& off,
                                          const ProgressCallback& progress);
    void settle(const ProgressCallback& progress);
    void make_weights(DisplayFilter& filter, const ProgressCallback& progress);

    const Scene& scene_;
    const Atlas& atlas_;
    const Lumels& lumels_;
    const KeptLightOptions options_;
    DynamicRayScene rays_;
    std::optional<Surfaces> surfaces_;
    WorldLumels world_;
    RayOrigins starts_;
    std::optional<LightSources> sources_;
    LumelLinks links_;
    std::optional<LumelSweeps> sweeps_;
    KeptError error_;
};

/// The scene itself. Throws Error{input} if it has coloured glass.
const Scene& without_coloured_glass(const Scene& scene);

}  // namespace lumel
