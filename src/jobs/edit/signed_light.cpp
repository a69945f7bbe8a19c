// Particles start at points drawn by |A_j 𝓛(source_j)|, leave cosine-distributed, and deposit their
// power at each lumel that they hit; reflected by its ρ, they continue by Russian roulette. The
// difference of two independent halves gives the error.

#include "jobs/edit/signed_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "base/core/sphere.h"
#include "jobs/edit/two_estimates.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Particles of each half in the first round. A later round at most doubles the total, as its error
/// estimate is noisy, and takes kMargin × the required number.
constexpr std::size_t kFirstParticles = 1 << 15;
constexpr double kMargin = 1.1;
/// Particles per task, and per summation of their landings.
constexpr std::size_t kParticlesPerTask = 1024, kParticlesPerStep = 1 << 17;
/// Maximum bounces of a particle: white rooms would reflect it forever.
constexpr std::uint32_t kMaxBounces = 256;
constexpr std::uint32_t kStratifiedBounces = 1;
/// Dimension pairs of a particle's random numbers.
constexpr std::uint32_t kPointPair = 0, kFirstBouncePair = 1, kPairsPerBounce = 2;

double size_of(const glm::vec3& light)
{
    return luminance(glm::abs(light));
}

}  // namespace

struct LightCarrier::Landing {
    std::uint32_t lumel;
    glm::vec3 power;
};

std::vector<double> LightCarrier::powers_of(std::span<const glm::vec3> source) const
{
    std::vector<double> sums;
    sums.reserve(source.size());
    double sum = 0.0;
    for (std::size_t j = 0; j < source.size(); ++j) {
        const Lumel& lumel = lumels_->lumels[j];
        if ((lumel.flags & kLumelBuried) == 0)
            sum += double(lumel.area) * size_of(source[j]);
        sums.push_back(sum);
    }
    return sums;
}

void LightCarrier::follow(std::uint32_t from, const glm::vec3& power, std::uint32_t stream,
                          std::uint32_t index, std::vector<Landing>& landings) const
{
    const PathSamples samples(stream, index);
    const float ray_offset = rays_->ray_offset();
    const LumelPoint y = world_->point_on(from, samples.stratified(kPointPair));
    glm::vec3 position = y.position, normal = y.normal, carried = power;
    for (std::uint32_t bounce = 0; bounce < kMaxBounces; ++bounce) {
        const std::uint32_t pair = kFirstBouncePair + kPairsPerBounce * bounce;
        const glm::vec2 at =
            bounce < kStratifiedBounces ? samples.stratified(pair) : samples.random(pair);
        const glm::vec3 direction = frame_about(normal) * by_cosine(at);
        RayHit hit;
        if (!rays_->closest(position + ray_offset * normal, direction, 0.0f,
                            std::numeric_limits<float>::max(), samples.bits(pair), hit))
            return;
        const std::uint32_t i = hits_->lumel(hit);
        if (i == HitLumels::kNone || (lumels_->lumels[i].flags & kLumelBuried) != 0)
            return;
        carried *= hit.tint;
        landings.push_back({i, carried});
        const glm::vec3 reflected = carried * lumels_->lumels[i].albedo;
        const double chance = std::min(size_of(reflected) / size_of(carried), 1.0);
        if (!(double(samples.random(pair + 1).x) < chance))
            return;
        carried = reflected * float(1.0 / chance);
        position += ray_offset * normal + hit.distance * direction;
        normal = hit.front ? hit.normal : -hit.normal;
    }
}

SignedLight LightCarrier::carry(std::span<const glm::vec3> source, double error, std::uint64_t most,
                                std::uint32_t seed,
                                const std::function<bool(const CarryState&)>& go_on) const
{
    const std::size_t count = source.size();
    SignedLight light{std::vector<glm::vec3>(count, glm::vec3(0.0f)), {}};
    const std::vector<double> sums = powers_of(source);
    if (sums.empty() || !(sums.back() > 0.0))
        return light;

    std::vector<glm::dvec3> sum[2] = {std::vector<glm::dvec3>(count),
                                      std::vector<glm::dvec3>(count)};
    TwoEstimates both(count);
    std::size_t done = 0;  // per half
    const auto follow_some = [&](std::uint32_t h, std::size_t first, std::size_t last) {
        const std::size_t tasks = (last - first + kParticlesPerTask - 1) / kParticlesPerTask;
        std::vector<std::vector<Landing>> landings(tasks);
        const std::uint32_t stream = PathSamples::hash(seed, h);
        parallel_for(tasks, 1, [&](std::size_t task, std::size_t end) {
            for (; task < end; ++task)
                for (std::size_t m = first + task * kParticlesPerTask;
                     m < std::min(first + (task + 1) * kParticlesPerTask, last); ++m) {
                    const double at =
                        double(PathSamples(~stream, std::uint32_t(m)).stratified(0).x) *
                        sums.back();
                    const auto j = std::uint32_t(std::min<std::ptrdiff_t>(
                        std::upper_bound(sums.begin(), sums.end(), at) - sums.begin(),
                        std::ptrdiff_t(count) - 1));
                    const glm::vec3 power = source[j] * float(sums.back() / size_of(source[j]));
                    follow(j, power, stream, std::uint32_t(m), landings[task]);
                }
        });
        for (const std::vector<Landing>& some : landings)
            for (const Landing& landing : some)
                sum[h][landing.lumel] += glm::dvec3(landing.power);
    };
    for (std::size_t goal = kFirstParticles;;) {
        while (done < goal) {
            const std::size_t last = std::min(done + kParticlesPerStep, goal);
            for (std::uint32_t h = 0; h < 2; ++h)
                follow_some(h, done, last);
            done = last;
            light.state.particles = 2 * done;
            if (go_on && !go_on(light.state))
                goal = done;
        }
        for (std::uint32_t h = 0; h < 2; ++h)
            for (std::size_t i = 0; i < count; ++i)
                both.half[h][i] = glm::vec3(
                    sum[h][i] / (double(done) * std::max(double(lumels_->lumels[i].area), 1e-30)));
        light.state.error = both.error();
        if (light.state.error <= error || (go_on && !go_on(light.state)))
            break;
        // The error falls with the square root of their number.
        const double lacking = light.state.error / error;
        light.state.gave_up = double(light.state.particles) * lacking * lacking > double(most);
        if (light.state.gave_up)
            break;
        goal = std::size_t(double(done) * std::min(kMargin * lacking * lacking, 2.0));
    }
    for (std::size_t i = 0; i < count; ++i)
        light.irradiance[i] = both.mean(i);
    return light;
}

}  // namespace lumel
