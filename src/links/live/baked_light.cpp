#include "links/live/baked_light.h"

#include <algorithm>

#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Progress when the scene is prepared, and at the first estimate.
constexpr double kPrepared = 0.1, kFirstLight = 0.5;

/// Ray limit per lumel of a bake to kUsualError or more: four times that of a default bake, because
/// a few lumels beside lamps can hold all of the error. For smaller errors it grows as 1 / error².
constexpr double kMostRays = 384.0, kUsualError = 0.02;
constexpr double kMostOfAll = 1e6;  ///< beyond any memory

std::uint64_t most_rays(double target_error)
{
    const double ratio = kUsualError / target_error;
    return std::uint64_t(std::clamp(kMostRays * ratio * ratio, kMostRays, kMostOfAll));
}

bool is_done(const SolverState& state, double target_error)
{
    return state.full || state.ended || (state.error >= 0.0 && state.error <= target_error);
}

}  // namespace

BakedLight bake_standing(StandingScene standing, const Lumels& own, const LinksOptions& options,
                         double target_error, const ProgressCallback& progress)
{
    const SolveScene scene(
        std::move(standing.scene),
        [&](const Scene&, const RayScene&, const ProgressCallback&) {
            return std::move(standing.atlas);
        },
        {}, part_of(progress, 0.0, kPrepared));
    LinkRadiosity solver(scene, options,
                         {.max_shots = most_rays(target_error),
                          .target_error = target_error,
                          .max_bytes = free_bytes_for_links()});
    for (SolverState state; !is_done(state, target_error); state = solver.state()) {
        notify(progress, kPrepared + (kFirstLight - kPrepared) * state.begun);
        solver.step();
    }
    return {.irradiance = carried(solver.irradiance(), scene.lumels, own),
            .error_estimate = carried(solver.error_estimate(), scene.lumels, own),
            .buried = carried(buried_of(scene.lumels), scene.lumels, own),
            .error = solver.state().error};
}

BakeAside::BakeAside(StandingScene standing, const Lumels& own, const LinksOptions& options,
                     double target_error)
{
    const auto stop_if_asked = [token = stop_.get_token()](double) {
        if (token.stop_requested())
            throw Error(ErrorKind::stopped, "", "the bake was stopped");
    };
    light_ = std::async(std::launch::async, [=, &own, standing = std::move(standing)]() mutable {
        return bake_standing(std::move(standing), own, options, target_error, stop_if_asked);
    });
}

bool BakeAside::has_ended(std::chrono::milliseconds wait) const
{
    return light_.wait_for(wait) == std::future_status::ready;
}

std::optional<BakedLight> BakeAside::take()
{
    try {
        return light_.get();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::stopped)
            throw;
        return std::nullopt;
    }
}

}  // namespace lumel
