#include "jobs/play/links_light.h"

#include <chrono>
#include <cmath>
#include <map>

#include "base/core/clock.h"

namespace lumel {
namespace {

using Groups = std::vector<std::vector<std::uint32_t>>;

std::vector<glm::mat4> places_of(const Scene& scene)
{
    std::vector<glm::mat4> places;
    for (const Instance& instance : scene.instances)
        places.push_back(instance.transform);
    return places;
}

std::unique_ptr<SolveScene> laid_out(const Scene& start, const Animation& animation,
                                     AtlasOptions atlas)
{
    atlas.sides = Sides::brighter;  // frames show one side per texel
    return lay_out_movers(at_its_brightest(start, animation), atlas, movers_of(animation, start));
}

LiveLinksOptions live_options(const PlayOptions& options, const Groups& groups)
{
    const auto& links = std::get<LinksOptions>(options.solver);
    LiveLinksOptions live{.rays = options.link_rays, .groups = groups, .seed = links.seed};
    live.light.seed = links.seed;
    live.filter = links.filter;
    live.residual = options.residual;
    return live;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> moving_together(const Scene& scene,
                                                        const Animation& animation)
{
    std::map<int, std::vector<std::uint32_t>> by_node;
    for (const std::uint32_t i : movers_of(animation, scene)) {
        int node = scene.instances[i].node;
        while (!animation.nodes[std::size_t(node)].moves())
            node = animation.nodes[std::size_t(node)].parent;
        by_node[node].push_back(i);
    }
    Groups groups;
    for (auto& [node, instances] : by_node)
        groups.push_back(std::move(instances));
    return groups;
}

LinksLight::LinksLight(const Scene& start, const Animation& animation, const PlayOptions& options)
    : start_(places_of(start)),
      lamps_(animation.materials),
      groups_(moving_together(start, animation)),
      links_(std::get<LinksOptions>(options.solver)),
      bake_error_(options.budget_ms > 0.0 ? 0.0 : options.bake_error),
      live_(laid_out(start, animation, options.atlas), live_options(options, groups_))
{
}

void LinksLight::change_to(const Scene& shown, double time)
{
    bake_.reset();
    for (std::uint32_t group = 0; group < groups_.size(); ++group) {
        const std::uint32_t any = groups_[group].front();
        const glm::mat4 &now = shown.instances[any].transform, &then = start_[any];
        live_.request(group, now == then
                                 ? glm::mat4(1.0f)
                                 : glm::mat4(glm::dmat4(now) * glm::inverse(glm::dmat4(then))));
    }
    for (const AnimatedMaterial& lamp : lamps_)
        live_.set_emission(std::uint32_t(lamp.material), emission_factor(lamp, time));
}

/// Bakes the scene at rest, or waits for `budget_ms` while that is done. Returns true once its
/// light is displayed.
bool LinksLight::bake(double budget_ms)
{
    if (live_.baked())
        return true;
    if (!bake_)
        bake_.emplace(live_.standing(), live_.lumels(), links_, bake_error_);
    if (!bake_->has_ended(std::chrono::milliseconds(std::lround(budget_ms))))
        return false;
    live_.show(bake_->take().value());
    bake_.reset();
    return true;
}

void LinksLight::update(double budget_ms, FrameRow& row)
{
    const LiveLinksState before = state_;
    const Clock::time_point start = Clock::now();
    state_ = live_.advance(budget_ms);
    row.at_rest = state_.at_rest && (!(bake_error_ > 0.0) || bake(budget_ms));
    row.update_ms += ms_since(start);
    row.residual = std::max(state_.residual, state_.dark_residual);
    if (!row.links)
        row.links.emplace();
    if (live_.baked())
        row.links->error = live_.baked()->error;
    row.links->retraced += state_.found.links.all() - before.found.links.all();
    row.links->direct += state_.found.direct - before.found.direct;
    row.links->sweeps += state_.all_sweeps - before.all_sweeps;
}

std::uint64_t LinksLight::shots() const
{
    return std::uint64_t(live_.lumels().lumels.size()) * live_.links().rays() +
           state_.found.links.all();
}

}  // namespace lumel
