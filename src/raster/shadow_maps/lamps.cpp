#include "raster/shadow_maps/lamps.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <span>
#include <vector>

#include "base/core/frame.h"
#include "base/core/lattice.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "raster/shadow_maps/lamps.receive.comp.h"
#include "raster/shadow_maps/lamps.shared.h"

namespace lumel {
namespace {

/// Distance of the random keys of two lamps.
constexpr std::uint32_t kLampKeys = 977;

/// True if the light needs two hemicubes to cover all directions.
bool has_halves(const PunctualLight& light)
{
    return light.kind == PunctualLight::Kind::point && light.radius == 0.0f;
}

Lamp lamp_of(const PunctualLight& light)
{
    Lamp lamp{.position = glm::vec3(light.transform[3]),
              .radius = light.radius,
              .x = glm::normalize(glm::vec3(light.transform[0])),
              .y = glm::normalize(glm::vec3(light.transform[1])),
              .z = glm::normalize(glm::vec3(light.transform[2])),
              .intensity = light.color * light.intensity,
              .range = light.range,
              .cone_scale = 0.0f,
              .cone_offset = 1.0f,
              .profile = light.profile < 0 ? kNoProfile : std::uint32_t(light.profile),
              .eyes_per_look = has_halves(light) ? 2u : 1u,
              .share = 1.0f};
    if (light.kind == PunctualLight::Kind::spot) {
        const float outer = std::cos(light.outer_cone);
        lamp.cone_scale = 1.0f / std::max(std::cos(light.inner_cone) - outer, kMinConeStep);
        lamp.cone_offset = -outer * lamp.cone_scale;
    }
    return lamp;
}

/// An eye facing `normal`, rotated about it by `turn` [rad].
Eye eye_at(const glm::vec3& position, const glm::vec3& normal, float turn, std::uint32_t random)
{
    const glm::mat3 frame = frame_about(normal);
    const glm::vec3 tangent = std::cos(turn) * frame[0] + std::sin(turn) * frame[1];
    return {position, tangent, glm::cross(normal, tangent), normal, random, kAllChannels};
}

/// Eyes of a lamp: points of its ball, or its centre with different rotations; as two halves for
/// all directions, or towards a spot's cone.
std::vector<Eye> eyes_of(const PunctualLight& light, const LampOptions& options, std::uint32_t key)
{
    std::vector<Eye> eyes;
    const glm::vec3 position(light.transform[3]);
    const bool ball = light.radius > 0.0f;
    const std::uint32_t count = ball ? options.ball_points : options.points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 direction = on_sphere(lattice_point(i, count, key));
        const float turn = 2.0f * kPi * lattice_point(i, count, ~key).y;
        const std::uint32_t random = key * count + i;
        if (ball) {
            eyes.push_back(eye_at(position + light.radius * direction, direction, turn, random));
        } else if (has_halves(light)) {
            eyes.push_back(eye_at(position, direction, turn, random));
            eyes.push_back(eye_at(position, -direction, turn, random));
        } else {
            const glm::vec3 axis = -glm::normalize(glm::vec3(light.transform[2]));
            eyes.push_back(eye_at(position, axis, turn, random));
        }
    }
    return eyes;
}

/// Repeats each eye for each channel.
std::vector<Eye> in_channels(const std::vector<Eye>& eyes)
{
    std::vector<Eye> all;
    for (const Eye& eye : eyes)
        for (std::uint32_t channel = 0; channel < kChannels; ++channel) {
            all.push_back(eye);
            all.back().channel = 1 + channel;
        }
    return all;
}

std::vector<float> profiles_of(const Scene& scene)
{
    std::vector<float> candela;
    for (const Photometry& profile : scene.profiles)
        candela.insert(candela.end(), profile.candela.begin(), profile.candela.end());
    return candela;
}

/// Eyes per batch.
std::uint32_t batch_of(const LampOptions& options)
{
    return std::uint32_t(std::max<std::uint64_t>(
        kMaxLightPixels / view_pixels(Projection::hemicube, options.hemicube), 1));
}

}  // namespace

std::uint64_t lamp_pixels(const LampOptions& options)
{
    return batch_of(options) * view_pixels(Projection::hemicube, options.hemicube);
}

/// Buffers shared by all lamps.
struct LampLight::Stage {
    Stage(const gpu::Device& on, const World& in, const Scene& scene, const std::vector<Lamp>& all,
          const LampOptions& given)
        : device(&on),
          world(&in),
          options(given),
          lamps(on, std::span<const Lamp>(all)),
          profiles(on, std::span<const float>(profiles_of(scene))),
          views(on, in, Projection::hemicube, given.hemicube, batch_of(given)),
          receive(on, std::uint32_t(Projection::hemicube)),
          pacer(on)
    {
    }

    /// Adds the light of some of a lamp's eyes. first: index of the batch's first eye.
    void take(std::span<const Eye> batch, std::uint32_t lamp, std::uint32_t first,
              const SummedLight& light)
    {
        const gpu::Array<Eye>& eyes = in_flight.emplace_back(*device, batch, "lamps.eyes");
        views.look_from(pacer, eyes, std::uint32_t(batch.size()));
        pacer.dispatch_parts("lamps", light.lumels(), kProbeLumels, receive,
                             {.lumels = world->lumels(),
                              .pieces = world->pieces(),
                              .views = {views.image(), views.sampler()},
                              .eyes = eyes,
                              .lamps = lamps,
                              .candela = profiles,
                              .sums = light.sums()},
                             {.views = views.layout(),
                              .lamp = lamp,
                              .first_eye = first,
                              .eyes = std::uint32_t(batch.size()),
                              .seed = options.seed,
                              .centre = options.centre ? 1u : 0u});
    }

    const gpu::Device* device;
    const World* world;
    LampOptions options;
    gpu::Array<Lamp> lamps;
    gpu::Array<float> profiles;
    EyeViews views;
    gpu::Kernel<shaders::LampsReceive> receive;
    std::deque<gpu::Array<Eye>> in_flight;  ///< until the pacer has finished
    gpu::Pacer pacer;  ///< last: its destructor waits for work that uses the others
};

LampLight::LampLight(const gpu::Device& device, const World& world, const Scene& scene,
                     const LampOptions& options, SummedLight& light)
    : light_(&light)
{
    std::vector<Lamp> lamps;
    for (const PunctualLight& lamp : scene.lights) {
        if (lamp.kind == PunctualLight::Kind::directional || !shines(lamp))
            continue;
        const auto key = options.seed + kLampKeys * std::uint32_t(lamps.size());
        eyes_.push_back(eyes_of(lamp, options, key));
        lamps.push_back(lamp_of(lamp));
        if (world.has_coloured_glass()) {
            eyes_.back() = in_channels(eyes_.back());
            lamps.back().eyes_per_look *= kChannels;
        }
        lamps.back().share = float(lamps.back().eyes_per_look) / float(eyes_.back().size());
    }
    if (!lamps.empty())
        stage_ = std::make_unique<Stage>(device, world, scene, lamps, options);
}

LampLight::~LampLight() = default;

void LampLight::step(std::uint64_t pixels)
{
    const std::span<const Eye> all(eyes_[lamp_]);
    const std::uint64_t fit = std::max<std::uint64_t>(
        pixels / view_pixels(Projection::hemicube, stage_->options.hemicube), 1);
    const std::size_t count =
        std::min<std::size_t>({fit, stage_->views.capacity(), all.size() - next_});
    stage_->take(all.subspan(next_, count), std::uint32_t(lamp_), std::uint32_t(next_), *light_);
    next_ += count;
    if (next_ < all.size())
        return;
    light_->finish_source(stage_->pacer);
    next_ = 0;
    if (++lamp_ == eyes_.size())
        light_->finish(stage_->pacer);
}

void LampLight::wait()
{
    stage_->pacer.finish();
    stage_->in_flight.clear();
}

double LampLight::done() const
{
    if (is_done())
        return 1.0;
    const double of_lamp = double(next_) / double(eyes_[lamp_].size());
    return (double(lamp_) + of_lamp) / double(eyes_.size());
}

void LampLight::finish()
{
    light_->finish_source(stage_->pacer);
    light_->finish(stage_->pacer);
}

}  // namespace lumel
