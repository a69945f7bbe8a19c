#include "methods/directions/leaky_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atlas/near/still_part.h"
#include "base/core/clock.h"
#include "base/core/error.h"

namespace lumel {
namespace {

/// The lamps without the sky, which directions gather.
LiveLamps lamps_of(const Scene& scene, const DirectLightOptions& options)
{
    Scene lamps;
    lamps.lights = scene.lights;
    lamps.profiles = scene.profiles;
    return {lamps, options};
}

DirectionsOptions leaky(DirectionsOptions options, double leak)
{
    options.iteration = {.scheme = Scheme::paper, .leak = leak};
    options.sky = true;
    return options;
}

}  // namespace

LeakyScene::LeakyScene(const gpu::Device& device, Scene scene, const LeakyOptions& options)
    : device_(&device),
      options_(options),
      scene_(std::move(scene)),
      sky_(scene_.sky.radiance),
      edits_(scene_, options.movers, options.still),
      atlas_(make_atlas(scene_, options.atlas)),
      lumels_(make_lumels(scene_, atlas_, edits_.movers())),
      world_(device, scene_, lumels_, &atlas_, edits_.movers()),
      lamps_(lamps_of(scene_, options.lights)),
      solver_(device, world_, lumels_, leaky(options.solver, options.leak))
{
    lamps_.find(device, world_, lumels_);
    begin_anew();
}

void LeakyScene::move(std::uint32_t instance, const glm::mat4& transform)
{
    edits_.move(scene_, instance, transform);
}

void LeakyScene::set_emission(std::uint32_t instance, const glm::vec3& factor)
{
    edits_.set_emission(instance, factor);
    changed_ = true;
}

void LeakyScene::set_reflectance(std::uint32_t instance, const glm::vec3& factor)
{
    edits_.set_reflectance(instance, factor);
    changed_ = true;
}

void LeakyScene::set_light(std::uint32_t light, const glm::vec3& factor)
{
    lamps_.set_light(light, factor);
    changed_ = true;
}

void LeakyScene::set_sky(const glm::vec3& factor)
{
    if (sky_.empty())
        throw Error(ErrorKind::input, "the sky", "is not in the scene");
    if (!glm::all(glm::greaterThanEqual(factor, glm::vec3(0.0f))))
        throw Error(ErrorKind::input, "the sky", "cannot emit a negative amount of light");
    for (std::size_t i = 0; i < sky_.size(); ++i)
        scene_.sky.radiance[i] = factor * sky_[i];
    changed_ = true;
}

/// Returns true if any instance has moved.
bool LeakyScene::place_what_moved()
{
    std::vector<glm::mat4> transforms;
    bool moved = false;
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
        Instance& instance = scene_.instances[i];
        if (const std::optional<glm::mat4> transform = edits_.take_move(scene_, i)) {
            instance.transform = *transform;
            moved = true;
        }
        transforms.push_back(instance.transform);
    }
    if (moved) {
        world_.bound(scene_);
        world_.place(transforms);
        lamps_.find(*device_, world_, lumels_);
    }
    return moved;
}

/// Passes the current emission to the solver; light gathered before decays.
void LeakyScene::begin_anew()
{
    Lumels lumels = edits_.scaled(lumels_);
    direct_ = lamps_.irradiance();
    // Reflected direct light joins the emission of surfaces: directions do not find lamps.
    for (std::size_t i = 0; i < direct_.size(); ++i)
        lumels.lumels[i].emission += lumels.lumels[i].albedo * direct_[i];
    solver_.relight(lumels);
    changed_ = false;
    changed_at_ = solver_.state().shots;
}

LiveState LeakyScene::update(double budget_ms)
{
    const Clock::time_point start = Clock::now();
    const bool moved = place_what_moved();
    if (moved || changed_) {
        begin_anew();
        state_.at_rest = false;
    }
    while (!state_.at_rest) {
        solver_.step();
        const double directions = double(solver_.state().shots - changed_at_);
        state_.residual = std::pow(1.0 - options_.leak, directions);
        state_.at_rest = state_.residual <= options_.residual;
        if (ms_since(start) >= budget_ms)
            break;
    }
    state_.hemicubes = solver_.state().shots;
    state_.milliseconds = ms_since(start);
    return state_;
}

LiveState LeakyScene::settle()
{
    return update(std::numeric_limits<double>::max());
}

std::vector<glm::vec3> LeakyScene::irradiance()
{
    std::vector<glm::vec3> irradiance = solver_.irradiance();
    for (std::size_t i = 0; i < direct_.size(); ++i)
        irradiance[i] += direct_[i];
    return irradiance;
}

}  // namespace lumel
