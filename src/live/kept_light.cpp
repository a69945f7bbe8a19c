#include "live/kept_light.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace lumel {
namespace {

/// Lumels worth a task.
constexpr std::size_t kGrain = 4096;

}  // namespace

const Scene& without_coloured_glass(const Scene& scene)
{
    for (const Material& material : scene.materials)
        if (is_coloured_glass(material))
            throw Error(ErrorKind::input, scene.path,
                        "has coloured glass (material \"" + material.name +
                            "\"), which links that are kept do not know; make it white, or "
                            "opaque");
    return scene;
}

KeptLight::KeptLight(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                     const KeptLightOptions& options, const KeptLinks* kept, const Watch& watch)
    : scene_(without_coloured_glass(scene)),
      atlas_(atlas),
      lumels_(lumels),
      options_(options),
      rays_(scene, {}),
      surfaces_(std::in_place, scene),
      world_(scene, rays_.still(), lumels),
      starts_(world_, nullptr, rays_.lift(), false),
      sources_(std::in_place, scene, *surfaces_,
               glm::distance(rays_.still().low(), rays_.still().high())),
      links_(place(), atlas, side_of_rays(options.rays), options.seed, kept, watch)
{
}

LivePlace KeptLight::place() const
{
    return {scene_, lumels_, rays_, *surfaces_, world_, starts_, *sources_, rays_.lift()};
}

/// Materials, lamps and sky as they are now.
void KeptLight::find_sources()
{
    surfaces_.emplace(scene_);
    sources_.emplace(scene_, *surfaces_, glm::distance(rays_.still().low(), rays_.still().high()));
    links_.find_sky();
}

std::vector<glm::vec3> KeptLight::irradiance(const Watch& watch)
{
    find_sources();
    constexpr double kDirect = 0.8;  // of the time, about
    GroupedLight light(place(), options_.light, part_of(watch, 0.0, kDirect));
    std::vector<glm::vec3> direct = light.sum(), sky;
    if (!scene_.sky.empty()) {
        sky = links_.sky_light();
        for (std::size_t i = 0; i < direct.size(); ++i)
            direct[i] += sky[i];
    }
    std::vector<glm::vec3> albedo;
    for (const Lumel& lumel : lumels_.lumels)
        albedo.push_back(lumel.albedo);
    sweeps_.emplace(links_);
    sweeps_->begin(direct, albedo);
    settle();
    tell(watch, 1.0);
    if (options_.filter)
        return filtered(sky);
    std::vector<glm::vec3> result(lumels_.lumels.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = sweeps_->irradiance(i);
    return result;
}

/// Sweeps until at rest.
void KeptLight::settle()
{
    SweepChange before;
    for (bool rests = false; !rests && sweeps_->sweeps() < kMostSweeps;) {
        while (!sweeps_->step(lumels_.lumels.size())) {
        }
        const SweepChange now = sweeps_->change();
        rests = std::max(still_to_come(now.all, before.all),
                         still_to_come(now.dark, before.dark)) <= options_.residual;
        before = now;
    }
}

std::vector<glm::vec3> KeptLight::filtered(const std::vector<glm::vec3>& sky)
{
    ShownFilter filter(place(), links_);
    filter.begin(*sweeps_, glm::vec3(1.0f));
    while (!filter.step()) {
    }
    std::vector<glm::vec3> result(lumels_.lumels.size());
    parallel_for(result.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            result[i] = filter.irradiance(*sweeps_, sky, i);
    });
    return result;
}

KeptLinks KeptLight::kept(const std::string& hash) const
{
    KeptLinks kept;
    kept.scene_hash = hash;
    keep_places(atlas_, kept);
    links_.keep(kept);
    return kept;
}

}  // namespace lumel
