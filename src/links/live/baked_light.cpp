#include "links/live/baked_light.h"

#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "base/core/usage.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Share of the free memory that links may take.
constexpr double kShareForLinks = 0.5;
/// Progress when the scene is prepared, and at the first estimate.
constexpr double kPrepared = 0.1, kFirstLight = 0.5;

bool is_done(const SolverState& state, double target_error)
{
    return state.full || state.ended || (state.error >= 0.0 && state.error <= target_error);
}

/// Assigns light to the live scene's lumels.
BakedLight light_at(const Lumels& own, const Lumels& solved, LinkRadiosity& solver)
{
    const std::size_t count = own.lumels.size();
    BakedLight light{.irradiance = std::vector<glm::vec3>(count, glm::vec3(0.0f)),
                     .error_estimate = std::vector<float>(count, 0.0f),
                     .buried = std::vector<char>(count, 0),
                     .error = solver.state().error};
    const std::vector<std::uint32_t> found = lumels_alike(solved, own);
    const std::vector<glm::vec3> irradiance = solver.irradiance();
    const std::vector<float> error = solver.error_estimate();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] == kNoLumel)
            continue;
        light.irradiance[found[i]] = irradiance[i];
        light.error_estimate[found[i]] = error[i];
        light.buried[found[i]] = (solved.lumels[i].flags & kLumelBuried) != 0;
    }
    return light;
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
    LinkRadiosity solver(
        scene, options,
        {.target_error = target_error,
         .max_bytes = std::uint64_t(kShareForLinks * double(available_memory_bytes()))});
    for (SolverState state; !is_done(state, target_error); state = solver.state()) {
        notify(progress, kPrepared + (kFirstLight - kPrepared) * state.begun);
        solver.step();
    }
    return light_at(own, scene.lumels, solver);
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
