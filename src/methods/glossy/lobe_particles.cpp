// A lobe of exponent n sends all its power into about 2π / n sr: light from one shooter's lobes to
// a receiver, Eq. (4) of [BSS05], has a variance in proportion to n / r², without bound where both
// are close, since p_j includes the power that a shooter sends but not its direction. A particle
// instead draws ω from the lobe: with the density q of phong_density,
//
//     f_r cosθ' / q = ρ_s cosθ' / max(cosθ, cosθ') ≤ 1,
//
// so that all particles have the same power, wherever they arrive, and no lumel receives more than
// its share of them.
//
// Light of the sky and of lamps starts at the lumels that it reaches, since most of it hits no
// lobe. Of the light from each of them along one drawn direction one is chosen by luminance, and a
// shadow ray tests it.
//
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on the
//           GPU. 2005.

#include "methods/glossy/lobe_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/core/parallel.h"
#include "lights/source_choice.h"
#include "methods/glossy/phong.h"

namespace lumel {
namespace {

constexpr std::size_t kParticlesPerTask = 512;
/// Maximum lobes per particle: facing mirrors would reflect it forever.
constexpr std::uint32_t kMaxTriedLobes = 256;
/// Lobes with stratified directions; later ones contribute too little.
constexpr std::uint32_t kStratifiedLobes = 1;

/// Dimension pairs of a particle's random numbers.
constexpr std::uint32_t kPointPair = 0, kDirectionPair = 1, kOffsetPair = 2, kChoicePair = 3,
                        kFirstLobePair = 4, kPairsPerLobe = 2;
/// Separates the random numbers of arriving light from those of leaving light.
constexpr std::uint32_t kArrivingStream = 0x5bf03635u;

bool has_lobes(const Lumels& lumels)
{
    return std::any_of(lumels.gloss.begin(), lumels.gloss.end(),
                       [](const Gloss& gloss) { return gloss.specular != glm::vec3(0.0f); });
}

/// A 𝓛(B) [lm], 0 for buried lumels.
double power_of(const Lumel& lumel, const glm::vec3& exitance)
{
    const bool counts = (lumel.flags & kLumelBuried) == 0;
    return counts ? double(lumel.area) * luminance(exitance) : 0.0;
}

}  // namespace

/// Power that arrives at a lumel from lobes, and its part reflected by the lobe.
struct LobeParticles::Landing {
    std::uint32_t lumel;
    glm::vec3 power, reflected;  ///< [lm]
};

/// Of particles that one task follows.
struct LobeParticles::Followed {
    std::vector<Landing> landings;
    double lobe_power = 0.0;  ///< reflected by lobes, first hits included [lm]
};

struct LobeParticles::Start {
    std::uint32_t lumel;
    /// [lm]; for arriving light, per lux at the lumel.
    glm::vec3 power;
    double whole;  ///< power of all particles [lm]
    bool arrives;  ///< true: from sky and lamps; false: leaves the lumel
    PathSamples samples;
};

struct LobeParticles::PathHit {
    std::uint32_t lumel;
    glm::vec3 position, direction;  ///< direction: unit, along its path
    glm::vec3 normal, geometric;
    glm::vec3 power;  ///< [lm]
};

/// Light of one source, weighted to represent all.
struct LobeParticles::Sought {
    glm::vec3 toward{0.0f};      ///< unit
    glm::vec3 irradiance{0.0f};  ///< [lx]
};

LobeParticles::LobeParticles(const SolveScene& scene)
    : rays_(&scene.rays),
      lumels_(&scene.lumels),
      surfaces_(&scene.surfaces),
      world_(scene.scene, scene.rays, scene.lumels),
      hits_(scene.scene, scene.atlas, scene.lumels),
      lamps_(scene.scene, scene.surfaces, scene.extent(), kLampsAlone),
      any_(has_lobes(scene.lumels))
{
    if (!scene.scene.sky.empty())
        sky_.emplace(scene.scene.sky);
    if (sky_ && sky_->empty())
        sky_.reset();
}

LobeParticles::Sought LobeParticles::seek_light(const LumelPoint& y,
                                                const PathSamples& samples) const
{
    const glm::vec2 at = samples.stratified(kDirectionPair);
    const RayOrigin start = origin_at(y.position + rays_->ray_offset() * y.normal, y.normal);
    SourceChoice choice(double(samples.random(kChoicePair).x));
    const auto offer = [&](const SourceSample& light) { choice.offer(light, light.irradiance); };
    if (sky_) {
        const SkySample sky = sky_->sample(at);
        if (sky.density > 0.0f)
            offer({.direction = sky.direction,
                   .distance = std::numeric_limits<float>::infinity(),
                   .irradiance = sky.radiance * (start.cosine(sky.direction) / sky.density)});
    }
    for (std::size_t lamp = 0; lamp < lamps_.count(); ++lamp)
        offer(lamps_.sample(lamp, start, at));
    if (choice.empty())
        return {};
    return {choice.sample().direction,
            choice.light() *
                transmittance_to(*rays_, choice.sample(), start, samples.bits(kChoicePair))};
}

/// Traces a particle to its next hit; false if none.
bool LobeParticles::fly(const glm::vec3& position, const glm::vec3& direction,
                        const glm::vec3& power, std::uint32_t bits, PathHit& arrival) const
{
    RayHit hit;
    if (!rays_->closest(position, direction, 0.0f, std::numeric_limits<float>::max(), bits, hit))
        return false;
    const std::uint32_t i = hits_.lumel(hit);
    if (i == HitLumels::kNone || (lumels_->lumels[i].flags & kLumelBuried) != 0)
        return false;
    const Shading there = surfaces_->shade(hit);
    arrival = {i,
               position + direction * hit.distance,
               direction,
               there.normal,
               there.geometric,
               power * hit.tint};
    return true;
}

/// Traces a particle to its first lobe; false if none.
bool LobeParticles::arrive(const Start& start, PathHit& arrival) const
{
    const PathSamples& samples = start.samples;
    const LumelPoint y = world_.point_on(start.lumel, samples.stratified(kPointPair));
    if (!start.arrives)
        // A lobe of exponent 1 about the normal is diffuse emission.
        return fly(y.position + rays_->ray_offset() * y.normal,
                   phong_direction(y.normal, 1.0f, samples.stratified(kDirectionPair)), start.power,
                   samples.bits(kFirstLobePair), arrival);
    const Sought light = seek_light(y, samples);
    arrival = {start.lumel, y.position, -light.toward,
               y.normal,    y.normal,   start.power * light.irradiance};
    return light.irradiance != glm::vec3(0.0f);
}

std::uint64_t LobeParticles::host_bytes(std::size_t particles)
{
    constexpr std::uint64_t kGrowth = 2;  // capacity of a vector over its size
    return kGrowth * particles * (sizeof(Start) + sizeof(Landing));
}

void LobeParticles::follow(const Start& start, Followed& followed) const
{
    const PathSamples& samples = start.samples;
    PathHit at;
    if (!arrive(start, at))
        return;
    for (std::uint32_t lobe = 0; lobe < kMaxTriedLobes; ++lobe) {
        const std::uint32_t pair = kFirstLobePair + kPairsPerLobe * lobe;
        const Gloss& gloss = lumels_->gloss[at.lumel];
        const float cos_in = -glm::dot(at.normal, at.direction);
        const glm::vec3 mirror = at.direction + 2.0f * cos_in * at.normal;
        const glm::vec3 onward = phong_direction(mirror, gloss.shininess,
                                                 lobe < kStratifiedLobes ? samples.stratified(pair)
                                                                         : samples.random(pair));
        const float cos_out = glm::dot(at.normal, onward);
        const bool leaves =
            cos_in > 0.0f && cos_out > 0.0f && glm::dot(at.geometric, onward) > 0.0f;
        const glm::vec3 reflected =
            leaves ? at.power * gloss.specular * (cos_out / std::max(cos_in, cos_out))
                   : glm::vec3(0.0f);
        followed.lobe_power += luminance(reflected);
        if (lobe > 0)  // the caller adds the light of first hits
            followed.landings.push_back({at.lumel, at.power, reflected});

        const double chance = luminance(reflected) / start.whole;
        if (!(double(samples.random(pair + 1).x) < chance))
            break;
        if (!fly(at.position + rays_->ray_offset() * at.geometric, onward,
                 reflected * float(1.0 / std::min(chance, 1.0)), samples.bits(pair + kPairsPerLobe),
                 at))
            break;
    }
}

/// Each lumel sends a number of particles in proportion to its power, rounded up or down by its own
/// random number: it does not depend on other lumels, so that small changes of light have small
/// effects. The numbers of neighbours are stratified.
std::vector<LobeParticles::Start> LobeParticles::starts_of(std::span<const glm::vec3> exitance,
                                                           std::span<const glm::vec3> direct,
                                                           std::size_t particles,
                                                           std::uint32_t seed) const
{
    const auto leaving = [&](std::size_t j) { return power_of(lumels_->lumels[j], exitance[j]); };
    const auto arriving = [&](std::size_t j) {
        return power_of(lumels_->lumels[j], lumels_->gloss[j].specular * direct[j]);
    };
    double total = 0.0;
    for (std::size_t j = 0; j < exitance.size(); ++j)
        total += leaving(j);
    for (std::size_t j = 0; j < direct.size(); ++j)
        total += arriving(j);
    std::vector<Start> starts;
    if (!(total > 0.0))
        return starts;
    starts.reserve(particles);
    const double offset = double(PathSamples(seed, 0).random(kOffsetPair).x);
    const double per_power = double(particles) / total;
    const auto add = [&](std::size_t j, double power, const glm::vec3& each, bool arrives) {
        const double place = double(j) + (arrives ? double(exitance.size()) : 0.0);
        const double number = offset + place * std::numbers::phi;
        const auto count = std::uint32_t(power * per_power + number - std::floor(number));
        const std::uint32_t stream =
            PathSamples::hash(arrives ? seed ^ kArrivingStream : seed, std::uint32_t(j));
        for (std::uint32_t t = 0; t < count; ++t)
            starts.push_back(
                {std::uint32_t(j), each, 1.0 / per_power, arrives, PathSamples(stream, t)});
    };
    for (std::size_t j = 0; j < exitance.size(); ++j)
        add(j, leaving(j), exitance[j] * float(1.0 / (per_power * luminance(exitance[j]))), false);
    for (std::size_t j = 0; j < direct.size(); ++j) {
        const double power = arriving(j);
        const float area = lumels_->lumels[j].area;
        add(j, power, glm::vec3(power > 0.0 ? float(double(area) / (power * per_power)) : 0.0f),
            true);
    }
    return starts;
}

LobeParticles::Carried LobeParticles::carry(std::span<const glm::vec3> exitance,
                                            std::span<const glm::vec3> direct,
                                            std::size_t particles, std::uint32_t seed) const
{
    const std::size_t count = exitance.size();
    Carried carried{std::vector<glm::vec3>(count, glm::vec3(0.0f)),
                    std::vector<glm::vec3>(count, glm::vec3(0.0f))};
    const std::vector<Start> starts = starts_of(exitance, direct, particles, seed);
    // Tasks collect separately, so that sums do not depend on their order.
    const std::size_t tasks = (starts.size() + kParticlesPerTask - 1) / kParticlesPerTask;
    std::vector<Followed> followed(tasks);
    const auto follow_some = [&](std::size_t task) {
        const std::size_t first = task * kParticlesPerTask;
        const std::size_t last = std::min(first + kParticlesPerTask, starts.size());
        for (std::size_t m = first; m < last; ++m)
            follow(starts[m], followed[task]);
    };
    parallel_for(tasks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t task = first; task < last; ++task)
            follow_some(task);
    });
    for (const Followed& some : followed) {
        carried.lobe_power += some.lobe_power;
        for (const Landing& landing : some.landings) {
            const float area = lumels_->lumels[landing.lumel].area;
            carried.irradiance[landing.lumel] += landing.power / area;
            carried.reflected[landing.lumel] += landing.reflected / area;
        }
    }
    return carried;
}

}  // namespace lumel
