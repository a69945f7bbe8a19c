#include "links/live/link_relighter.h"

#include "base/core/error.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Lumels per task, and per part of a sweep between progress reports.
constexpr std::size_t kRelitPerTask = 4096, kRelitPerStep = 1u << 18;
/// Progress fractions: direct light of the total, sweeps of the rest, filter weights of the
/// remainder.
constexpr double kDirect = 0.7, kSweeps = 0.3, kWeights = 0.3;

}  // namespace

LinkRelighter::LinkRelighter(const SolveScene& scene, const KeptLightOptions& options,
                             const StoredLinks* kept, const ProgressCallback& progress)
    : scene_(scene),
      options_(options),
      rays_(scene, {}),
      world_(scene.scene, scene.rays, scene.lumels),
      starts_(world_, nullptr, scene.rays.ray_offset(), false),
      sources_(std::in_place, scene.scene, scene.surfaces, scene.extent()),
      links_(place(), side_of_rays(options.rays), options.seed, kept, progress)
{
}

LinkContext LinkRelighter::place() const
{
    return {scene_, rays_, world_, starts_, *sources_};
}

/// Updates sources from the current materials, lamps and sky.
void LinkRelighter::find_sources()
{
    surfaces_.emplace(scene_.scene);
    sources_.emplace(scene_.scene, *surfaces_, scene_.extent());
    links_.find_sky();
}

std::vector<glm::vec3> LinkRelighter::irradiance(const ProgressCallback& progress)
{
    find_sources();
    std::vector<glm::vec3> off;
    const std::vector<glm::vec3> lamps = light_of_lamps(off, part_of(progress, 0.0, kDirect));
    std::vector<glm::vec3> direct = lamps, albedo;
    const std::vector<glm::vec3>& sky = links_.sky_light();
    for (std::size_t i = 0; i < direct.size(); ++i) {
        direct[i] += sky[i];
        albedo.push_back(scene_.lumels.lumels[i].albedo);
    }
    sweeps_.emplace(links_);
    sweeps_->begin(direct, albedo);
    const ProgressCallback after = part_of(progress, kDirect, 1.0);
    settle(part_of(after, 0.0, kSweeps));
    const ProgressCallback rest = part_of(after, kSweeps, 1.0);
    std::optional<DisplayFilter> filter;
    if (options_.filter)
        make_weights(filter.emplace(place(), links_), part_of(rest, 0.0, kWeights));
    std::vector<glm::vec3> result(scene_.lumels.lumels.size());
    parallel_for(result.size(), kRelitPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            result[i] = filter ? filter->irradiance(*sweeps_, sky, i) : sweeps_->irradiance(i);
    });
    error_ = error_of({links_, *sweeps_, scene_.lumels.lumels, lamps, off, albedo, result},
                      filter ? &*filter : nullptr, part_of(rest, kWeights, 1.0));
    notify(progress, 1.0);
    return result;
}

/// [N] [lx] Light from lamps, emissive surfaces and the bright part of the sky; off: as in
/// LightGroups.
std::vector<glm::vec3> LinkRelighter::light_of_lamps(std::vector<glm::vec3>& off,
                                                     const ProgressCallback& progress)
{
    GroupedLightOptions options = options_.light;
    options.halves = true;
    LightGroups light(place(), options, progress);
    off = light.off();
    return light.sum();
}

/// Sweeps until converged.
void LinkRelighter::settle(const ProgressCallback& progress)
{
    for (bool rests = false; !rests;) {
        rests = sweeps_->step(kRelitPerStep) && sweeps_->rests(options_.residual);
        notify(progress, rests ? 1.0 : 0.0);
    }
}

void LinkRelighter::make_weights(DisplayFilter& filter, const ProgressCallback& progress)
{
    filter.begin(*sweeps_, glm::vec3(1.0f));
    while (!filter.step())
        notify(progress, 0.0);
}

StoredLinks LinkRelighter::kept(const std::string& hash) const
{
    StoredLinks kept;
    kept.scene_hash = hash;
    keep_places(scene_.atlas, kept);
    links_.keep(kept);
    return kept;
}

}  // namespace lumel
