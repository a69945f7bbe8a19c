// Radiosity by global directions, with direct light of emissive surfaces by rays.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.
//
//     D ← direct light of emissive surfaces, by shadow rays                     direct_rays.h
//     E ← ρ (D + direct light of sky and lamps)
//     H ← D + light gathered from E by [TN11]                                   directions.h
//
// In the paper directions find all light. Few of them hit a small lamp: in the Cornell box at 128²
// 13,000 directions leave an estimated error of 6 %.

#include "methods/directions/directions_radiosity.h"

#include <cmath>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Error of direct light relative to the target; the directions' own, √(1 - share²), completes it.
constexpr double kDirectShare = 0.5;
/// Target error of direct light if none is given.
constexpr double kUsualError = 0.005;

}  // namespace

DirectionsRadiosity::DirectionsRadiosity(const gpu::Device& device, const World& world,
                                         const SolveScene& scene, const Lumels& lumels,
                                         const DirectionsOptions& options, double target_error,
                                         std::span<const glm::vec3> known, Parts parts)
    : device_(&device),
      world_(&world),
      options_(options),
      parts_(parts),
      direct_error_(target_error > 0.0 ? kDirectShare * target_error : kUsualError),
      known_(known.begin(), known.end()),
      reflecting_(lumels),
      direct_(scene, options.seed, direct_error_, known),
      reflects_(parts != Parts::direct && reflecting_area(lumels) > 0.0f)
{
}

void DirectionsRadiosity::step()
{
    if (directions_) {
        directions_->step();
        return;
    }
    direct_.step();
    const SolverState state = direct_.state();
    if (reflects_ && (state.full || (state.error >= 0.0 && state.error <= direct_error_)))
        begin_directions();
}

void DirectionsRadiosity::begin_directions()
{
    std::vector<glm::vec3> light = direct_.irradiance();
    add_light(light, known_);
    for (std::size_t i = 0; i < light.size(); ++i)
        reflecting_.lumels[i].emission = reflecting_.lumels[i].albedo * light[i];
    directions_.emplace(*device_, *world_, reflecting_, options_, light);
}

SolverState DirectionsRadiosity::state() const
{
    SolverState state = direct_.state();
    if (!reflects_)
        return state;
    state.full = false;
    if (!directions_) {
        state.shots = 0;
        state.error = -1.0;
        return state;
    }
    const SolverState onward = directions_->state();
    state.shots = onward.shots;
    state.iterations += onward.iterations;
    state.error = onward.error < 0.0 ? -1.0 : std::hypot(state.error, onward.error);
    return state;
}

std::vector<glm::vec3> DirectionsRadiosity::irradiance()
{
    std::vector<glm::vec3> light(reflecting_.lumels.size());
    if (parts_ != Parts::indirect)
        light = direct_.irradiance();
    if (directions_)
        add_light(light, directions_->irradiance());
    return light;
}

const gpu::StageTimes& DirectionsRadiosity::times() const
{
    return directions_ ? directions_->times() : none_;
}

double DirectionsRadiosity::longest_submission() const
{
    return directions_ ? directions_->longest_submission() : 0.0;
}

}  // namespace lumel
