#include "lights/lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/r2_sequence.h"
#include "lights/lamps.shared.h"

namespace lumel {
namespace {

constexpr std::uint32_t kReceiveSpirv[] = {
#include "lights/lamps.receive.comp.inc"
};

constexpr gpu::Slot kReceiveSlots[] = {gpu::Slot::array, gpu::Slot::array, gpu::Slot::array,
                                       gpu::Slot::array, gpu::Slot::array, gpu::Slot::array,
                                       gpu::Slot::texture, gpu::Slot::array};

constexpr float kPi = std::numbers::pi_v<float>;
/// Units tried first when a kind of work is timed (see gpu::Pacer).
constexpr std::uint32_t kProbeLumels = 4096;
/// Least difference of a cone's cosines that counts as soft (KHR_lights_punctual).
constexpr float kLeastConeStep = 0.001f;

Lamp lamp_of(const PunctualLight& light)
{
    Lamp lamp{.x = glm::normalize(glm::vec3(light.transform[0])),
              .y = glm::normalize(glm::vec3(light.transform[1])),
              .z = glm::normalize(glm::vec3(light.transform[2])),
              .intensity = light.color * light.intensity,
              .range = light.range,
              .cone_scale = 0.0f,
              .cone_offset = 1.0f,
              .profile = light.profile < 0 ? kNoProfile : std::uint32_t(light.profile)};
    if (light.kind == PunctualLight::Kind::spot) {
        const float outer = std::cos(light.outer_cone);
        lamp.cone_scale = 1.0f / std::max(std::cos(light.inner_cone) - outer, kLeastConeStep);
        lamp.cone_offset = -outer * lamp.cone_scale;
    }
    return lamp;
}

/// All eyes of all lamps.
struct Shots {
    std::vector<Lamp> lamps;
    std::vector<Eye> eyes;
    std::vector<LampShot> shots;

    void add(const glm::vec3& position, const glm::vec3& normal, float turn, float share, bool ball)
    {
        const glm::vec3 other =
            std::abs(normal.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
        const glm::vec3 s = glm::normalize(glm::cross(other, normal)), t = glm::cross(normal, s);
        const glm::vec3 tangent = std::cos(turn) * s + std::sin(turn) * t;
        eyes.push_back({position, tangent, glm::cross(normal, tangent), normal,
                        std::uint32_t(eyes.size())});
        shots.push_back({std::uint32_t(lamps.size()) - 1, share, ball ? 1u : 0u});
    }
};

glm::vec3 on_sphere(const glm::vec2& at)
{
    const float z = 1.0f - 2.0f * at.x, r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    return {r * std::cos(2.0f * kPi * at.y), r * std::sin(2.0f * kPi * at.y), z};
}

void add_light(Shots& shots, const PunctualLight& light, const LampOptions& options)
{
    shots.lamps.push_back(lamp_of(light));
    const glm::vec3 position(light.transform[3]);
    const std::uint32_t key = options.seed + 977u * std::uint32_t(shots.lamps.size());
    const bool ball = light.radius > 0.0f;
    const bool spot = light.kind == PunctualLight::Kind::spot;
    const std::uint32_t count = ball ? options.ball_points : options.points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec2 at = r2_point(i, key);
        const glm::vec3 way = on_sphere(at);
        const float turn = 2.0f * kPi * r2_point(i, ~key).x, share = 1.0f / float(count);
        if (ball) {
            shots.add(position + light.radius * way, way, turn, share, true);
        } else if (spot) {
            shots.add(position, -shots.lamps.back().z, turn, share, false);
        } else {  // all around: two halves
            shots.add(position, way, turn, share, false);
            shots.add(position, -way, turn, share, false);
        }
    }
}

Shots shots_of(const Scene& scene, const LampOptions& options)
{
    Shots shots;
    for (const PunctualLight& light : scene.lights)
        if (light.kind != PunctualLight::Kind::directional && light.intensity > 0.0f &&
            light.color != glm::vec3(0.0f))
            add_light(shots, light, options);
    return shots;
}

std::vector<float> profiles_of(const Scene& scene)
{
    std::vector<float> candela;
    for (const Photometry& profile : scene.profiles)
        candela.insert(candela.end(), profile.candela.begin(), profile.candela.end());
    return candela;
}

}  // namespace

bool add_lamps(gpu::Pacer& pacer, const gpu::Device& device, const World& world,
               const Scene& scene, const LampOptions& options,
               const gpu::Array<glm::vec3>& irradiance, const std::function<bool(double)>& go_on)
{
    const Shots shots = shots_of(scene, options);
    if (shots.shots.empty())
        return true;
    const gpu::Array<Lamp> lamps(device, std::span<const Lamp>(shots.lamps));
    const gpu::Array<LampShot> shot_array(device, std::span<const LampShot>(shots.shots));
    const std::vector<float> candela = profiles_of(scene);
    const gpu::Array<float> profiles(device, std::span<const float>(candela));
    const auto total = std::uint32_t(shots.shots.size()), lumels = std::uint32_t(irradiance.size());
    EyeViews views(device, world, options.projection, options.hemicube,
                   std::min(options.batch, total));
    const gpu::Kernel receive(device, "lamps.receive", kReceiveSpirv, kReceiveSlots,
                              sizeof(LampReceiveParams), kLampGroup,
                              std::uint32_t(options.projection));

    std::vector<gpu::Array<Eye>> batches;  // in flight until the pacer has finished
    bool going = true;
    for (std::uint32_t begin = 0; begin < total && going; begin += views.capacity()) {
        const std::uint32_t count = std::min(views.capacity(), total - begin);
        const gpu::Array<Eye>& eyes =
            batches.emplace_back(device, std::span<const Eye>(shots.eyes).subspan(begin, count));
        views.look_from(pacer, eyes, count);
        pacer.work("lamps", lumels, kProbeLumels,
                   [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                       const LampReceiveParams params{.views = views.layout(),
                                                      .first = first,
                                                      .last = last,
                                                      .first_shot = begin,
                                                      .shots = count,
                                                      .iteration = std::uint32_t(batches.size()),
                                                      .seed = options.seed,
                                                      .centre = options.centre ? 1u : 0u,
                                                      .polar_steps = Photometry::kPolarSteps,
                                                      .azimuth_steps = Photometry::kAzimuthSteps};
                       commands.dispatch(receive,
                                         {world.lumels(),
                                          world.pieces(),
                                          eyes,
                                          shot_array,
                                          lamps,
                                          profiles,
                                          {views.image(), views.sampler()},
                                          irradiance},
                                         params, last - first);
                   });
        going = go_on(double(begin + count) / double(total));
    }
    pacer.finish();
    return going;
}

}  // namespace lumel
