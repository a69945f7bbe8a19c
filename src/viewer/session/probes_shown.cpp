// Light probes for the displayed light.

#include <numbers>

#include "base/core/luminance.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

constexpr float kBall = 0.12f;        ///< radius of a ball, in grid spacings
constexpr std::uint32_t kRays = 256;  ///< minimum per probe, and as many to sources

}  // namespace

void ViewSession::set_probes(double spacing)
{
    ball_places_ = spacing > 0.0 ? ball_places(shown_, rays(), spacing) : std::vector<glm::vec3>();
    probe_spacing_ = spacing;
    by_links_.has_balls = by_solver_.has_balls = false;
    balls_.clear();
}

/// Probes of the last converged light: they take longer than a frame.
const std::vector<ProbeBall>& ViewSession::probe_balls()
{
    const bool solved = shows_solved();
    const bool known = seen().has_balls && balls_of_solved_ == solved;
    if (known || !(probe_spacing_ > 0.0) || !(solved || live_.state().at_rest))
        return balls_;
    const StandingScene standing = this->standing(shown_.model);
    Lumels lumels = shown_lumels();
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        lumels.lumels[i].albedo = live_.albedo()[i];
    const LightProbe probe(standing.scene, rays(), drawn_, lumels, irradiance(),
                           {.samples = kRays, .seed = options_.seed});
    balls_ = find_balls(probe, ball_places_);
    balls_of_solved_ = solved;
    seen().has_balls = true;
    return balls_;
}

/// Draws white balls into an image of radiance.
void ViewSession::draw_lit_balls(Image& light)
{
    draw_balls(light, camera_.view(), rays(), probe_balls(), kBall * float(probe_spacing_),
               [](float* pixel, const glm::vec3& irradiance) {
                   for (int c = 0; c < 3; ++c)
                       pixel[c] = irradiance[c] / std::numbers::pi_v<float>;
                   pixel[3] = 1.0f;
               });
}

/// Draws illuminance into a one-channel image [lx].
void ViewSession::draw_lux_balls(Image& lux)
{
    draw_balls(
        lux, camera_.view(), rays(), probe_balls(), kBall * float(probe_spacing_),
        [](float* pixel, const glm::vec3& irradiance) { *pixel = float(luminance(irradiance)); });
}

}  // namespace lumel
