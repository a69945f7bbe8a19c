// A lobe of exponent n sends all its power into about 2π / n sr: what one shooter's lobes bring to
// a receiver, Eq. (4) of [BSS05], has a variance in proportion to n / r², without bound where both
// are close, for p_j includes the power that a shooter sends but not its direction. A particle
// instead draws ω from the lobe: with the density q of phong_density,
//
//     f_r cosθ' / q = ρ_s cosθ' / max(cosθ, cosθ') ≤ 1,
//
// so that each brings the same power, wherever it lands, and no lumel more than its share of them.
//
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on the
//           GPU. 2005.

#include "lobes/lobe_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "lobes/phong.h"
#include "paths/samples.h"
#include "shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Particles worth a task.
constexpr std::size_t kParticlesPerTask = 512;
/// Lobes that one particle follows at most: mirrors that face each other would hold it for ever.
constexpr std::uint32_t kMostLobes = 256;
/// Lobes whose directions are stratified; later ones add too little for it to pay.
constexpr std::uint32_t kStratifiedLobes = 1;

/// Dimension pairs of a particle's random numbers.
constexpr std::uint32_t kPointPair = 0, kDirectionPair = 1, kOffsetPair = 2, kFirstLobePair = 3,
                        kPairsPerLobe = 2;

bool has_lobes(const Lumels& lumels)
{
    return std::any_of(lumels.gloss.begin(), lumels.gloss.end(),
                       [](const Gloss& gloss) { return gloss.specular != glm::vec3(0.0f); });
}

/// A 𝓛(B) [lm], 0 where buried.
double power_of(const Lumel& lumel, const glm::vec3& exitance)
{
    const bool counts = (lumel.flags & kLumelBuried) == 0;
    return counts ? double(lumel.area) * luminance(exitance) : 0.0;
}

}  // namespace

/// Power that arrives at a lumel, and how much of it a lobe reflects.
struct LobeParticles::Landing {
    std::uint32_t lumel;
    glm::vec3 power, reflected;  ///< [lm]
};

struct LobeParticles::Start {
    std::uint32_t lumel;
    glm::vec3 power;  ///< [lm]
    PathSamples samples;
};

LobeParticles::LobeParticles(const Scene& scene, const Atlas& atlas, const RayScene& rays,
                             const Lumels& lumels)
    : rays_(&rays),
      lumels_(&lumels),
      world_(scene, rays, lumels),
      surfaces_(scene),
      hits_(scene, atlas, lumels),
      any_(has_lobes(lumels))
{
}

void LobeParticles::follow(const Start& start, std::vector<Landing>& landings) const
{
    const PathSamples& samples = start.samples;
    const LumelPoint y = world_.point_on(start.lumel, samples.stratified(kPointPair));
    const float lift = rays_->lift();
    const double whole = luminance(start.power);
    glm::vec3 position = y.position + lift * y.normal;
    // A lobe of exponent 1 about the normal is what a diffuse surface sends.
    glm::vec3 direction = phong_direction(y.normal, 1.0f, samples.stratified(kDirectionPair));
    glm::vec3 power = start.power;
    for (std::uint32_t lobe = 0; lobe < kMostLobes; ++lobe) {
        const std::uint32_t pair = kFirstLobePair + kPairsPerLobe * lobe;
        RayHit hit;
        if (!rays_->closest(position, direction, 0.0f, std::numeric_limits<float>::max(),
                            samples.bits(pair), hit))
            break;
        const std::uint32_t i = hits_.lumel(hit);
        if (i == HitLumels::kNone || (lumels_->lumels[i].flags & kLumelBuried) != 0)
            break;
        power *= hit.tint;
        const Gloss& gloss = lumels_->gloss[i];
        const Shading there = surfaces_.shade(hit);
        const float cos_in = -glm::dot(there.normal, direction);
        const glm::vec3 mirror = direction + 2.0f * cos_in * there.normal;
        const glm::vec3 onward = phong_direction(mirror, gloss.shininess,
                                                 lobe < kStratifiedLobes ? samples.stratified(pair)
                                                                         : samples.random(pair));
        const float cos_out = glm::dot(there.normal, onward);
        const bool leaves =
            cos_in > 0.0f && cos_out > 0.0f && glm::dot(there.geometric, onward) > 0.0f;
        const glm::vec3 reflected =
            leaves ? power * gloss.specular * (cos_out / std::max(cos_in, cos_out))
                   : glm::vec3(0.0f);
        if (lobe > 0)
            landings.push_back({i, power, reflected});

        const double chance = luminance(reflected) / whole;
        if (!(double(samples.random(pair + 1).x) < chance))
            break;
        power = reflected * float(1.0 / std::min(chance, 1.0));
        position += direction * hit.distance + lift * there.geometric;
        direction = onward;
    }
}

/// Each lumel sends as many as its power is worth, rounded up or down by a number of its own:
/// what one sends does not depend on the others', so that a little more light changes little. The
/// numbers of neighbours are spread evenly.
std::vector<LobeParticles::Start> LobeParticles::starts_of(std::span<const glm::vec3> exitance,
                                                           std::size_t particles,
                                                           std::uint32_t seed) const
{
    double total = 0.0;
    for (std::size_t j = 0; j < exitance.size(); ++j)
        total += power_of(lumels_->lumels[j], exitance[j]);
    std::vector<Start> starts;
    if (!(total > 0.0))
        return starts;
    starts.reserve(particles);
    const double offset = double(PathSamples(seed, 0).random(kOffsetPair).x);
    const double per_power = double(particles) / total;
    for (std::size_t j = 0; j < exitance.size(); ++j) {
        const double power = power_of(lumels_->lumels[j], exitance[j]);
        const double number = offset + double(j) * std::numbers::phi;
        const auto count = std::uint32_t(power * per_power + number - std::floor(number));
        const std::uint32_t stream = PathSamples::hash(seed, std::uint32_t(j));
        for (std::uint32_t t = 0; t < count; ++t)
            starts.push_back({std::uint32_t(j),
                              exitance[j] * float(1.0 / (per_power * luminance(exitance[j]))),
                              PathSamples(stream, t)});
    }
    return starts;
}

LobeParticles::Carried LobeParticles::carry(std::span<const glm::vec3> exitance,
                                            std::size_t particles, std::uint32_t seed) const
{
    const std::size_t count = exitance.size();
    Carried carried{std::vector<glm::vec3>(count, glm::vec3(0.0f)),
                    std::vector<glm::vec3>(count, glm::vec3(0.0f))};
    const std::vector<Start> starts = starts_of(exitance, particles, seed);
    // Tasks keep their landings apart, so that sums do not depend on which is first.
    const std::size_t tasks = (starts.size() + kParticlesPerTask - 1) / kParticlesPerTask;
    std::vector<std::vector<Landing>> landings(tasks);
    const auto follow_some = [&](std::size_t task) {
        const std::size_t first = task * kParticlesPerTask;
        const std::size_t last = std::min(first + kParticlesPerTask, starts.size());
        for (std::size_t m = first; m < last; ++m)
            follow(starts[m], landings[task]);
    };
    parallel_for(tasks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t task = first; task < last; ++task)
            follow_some(task);
    });
    for (const std::vector<Landing>& some : landings)
        for (const Landing& landing : some) {
            const float area = lumels_->lumels[landing.lumel].area;
            carried.irradiance[landing.lumel] += landing.power / area;
            carried.reflected[landing.lumel] += landing.reflected / area;
        }
    return carried;
}

}  // namespace lumel
