// Iterated gathering through the lightmap, as progressive lightmappers do it on the processor: the
// same rays from every lumel, no filter.
//
// The light of a lumel is H = D + X, D direct and X reflected. In every pass it sends a few rays to
// points on the light sources and as many spread by the cosine. The first, and those of the second
// that meet a source, estimate D (truth/lights.cpp). Where a ray of the second kind meets a
// lumel j,
//
//     X ≈ ρ H_j,
//
// H_j being what the lightmap has for j at that time. So a pass knows one reflection more than the
// one before. D and X are means over passes; but as the first of them lack reflections, a mean over
// all would approach the solution slowly. What warm-up passes find of X therefore serves the next
// pass alone.

#include "bench/iterated_gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/core/parallel.h"

namespace lumel::bench {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kFar = std::numeric_limits<float>::max();

/// Rays of a lumel in one pass. A power of two, so that they are stratified.
constexpr std::uint32_t kRays = 4;
/// Warm-up ends where this part of the light is left to the reflections that are still missing;
/// later passes find most of that.
constexpr double kLeft = 0.002;
/// For scenes that absorb next to nothing.
constexpr std::uint32_t kMaxWarmUp = 64;
/// Surfaces that a ray goes on from because no lumel is where it met them.
constexpr int kMaxSteps = 8;
/// Fewest lumels worth a task.
constexpr std::size_t kLumelsPerTask = 64;

/// Passes until little of the light is missing: each leaves the share that surfaces reflect.
std::uint32_t warm_up_of(const Lumels& lumels)
{
    glm::dvec3 albedo(0.0);
    double area = 0.0;
    for (const Lumel& lumel : lumels.lumels) {
        albedo += glm::dvec3(lumel.area * lumel.albedo);
        area += double(lumel.area);
    }
    const double reflected = std::max({albedo.r, albedo.g, albedo.b}) / area;
    if (!(reflected > kLeft))
        return 1;
    if (!(reflected < 1.0))
        return kMaxWarmUp;
    return std::uint32_t(
        std::min(std::ceil(std::log(kLeft) / std::log(reflected)), double(kMaxWarmUp)));
}

}  // namespace

IteratedGather::IteratedGather(const SolveScene& place, SampleRule rule, std::uint32_t seed)
    : place_(place),
      surfaces_(place.scene),
      lights_(place.scene, place.rays, surfaces_),
      starts_(place.scene, place.rays, place.lumels, rule),
      hits_(place.scene, place.atlas, place.lumels),
      seed_(seed),
      warm_up_(warm_up_of(place.lumels))
{
    present_.assign(place.lumels.lumels.size(), glm::vec3(0.0f));
    direct_.light = bounced_.light = present_;
}

bool IteratedGather::is_open(std::uint32_t lumel) const
{
    return lumel != HitLumels::kNone && !(place_.lumels.lumels[lumel].flags & kLumelBuried);
}

/// Samples the light sources and one direction. Where that ends at a surface without a
/// lumel, as at the border of a chart, it looks on from there.
IteratedGather::Seen IteratedGather::look(PathVertex vertex, const PathSamples& path) const
{
    Seen seen;
    glm::vec3 weight(1.0f);
    for (int step = 0; step < kMaxSteps; ++step) {
        const BounceSamples samples(path, step);
        glm::vec3& light = step == 0 ? seen.direct : seen.bounced;
        light += weight * lights_.sought(vertex, samples);

        const glm::vec3 direction = vertex.brdf.sample(samples.point(Draw::direction));
        if (!(cosine_above(vertex, direction) > 0.0f))
            return seen;
        const float density = vertex.brdf.respond(direction).density;
        RayHit hit;
        const bool met = place_.rays.closest(vertex.position, direction, 0.0f, kFar,
                                             samples.bits(Draw::direction), hit);
        weight *= hit.tint;
        if (!met) {
            light += kPi * weight * lights_.met_sky(direction, density);
            return seen;
        }
        const Shading shading = surfaces_.shade(hit);
        if (shading.luminance != glm::vec3(0.0f))
            light += kPi * weight * lights_.met(hit, shading, direction, density);
        weight *= shading.reflectance.diffuse;
        if (weight == glm::vec3(0.0f))
            return seen;
        if (const std::uint32_t j = hits_.lumel(hit); is_open(j)) {
            seen.bounced += weight * present_[j];
            return seen;
        }
        vertex = {vertex.position + direction * std::max(0.0f, hit.distance - hit.ray_offset) +
                      hit.ray_offset * shading.geometric,
                  shading.geometric, Brdf(shading.normal)};
    }
    return seen;
}

void IteratedGather::pass()
{
    const std::vector<Lumel>& lumels = place_.lumels.lumels;
    if (passes_ <= warm_up_)
        bounced_ = {std::vector<glm::vec3>(lumels.size(), glm::vec3(0.0f)), 0};
    // Warm-up has random numbers of its own, so that those that count are stratified from the
    // first.
    const std::uint32_t key = PathSamples::hash(seed_, passes_ < warm_up_ ? 1 : 0);
    const std::uint32_t first_ray = passes_ < warm_up_ ? passes_ * kRays : bounced_.rays;
    const auto take = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (!is_open(std::uint32_t(i)))
                continue;
            const std::uint32_t own = PathSamples::hash(key, std::uint32_t(i));
            for (std::uint32_t ray = first_ray; ray < first_ray + kRays; ++ray) {
                const PathSamples samples(own, ray);
                const Seen seen = look(starts_.start(i, samples.stratified(kStartPair)), samples);
                direct_.light[i] += seen.direct;
                bounced_.light[i] += seen.bounced;
            }
        }
    };
    parallel_for(lumels.size(), kLumelsPerTask, take);
    direct_.rays += kRays;
    bounced_.rays += kRays;
    ++passes_;
    present_ = irradiance();
}

std::vector<glm::vec3> IteratedGather::irradiance() const
{
    std::vector<glm::vec3> sum(present_.size(), glm::vec3(0.0f));
    if (bounced_.rays == 0)
        return sum;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] = direct_.light[i] / float(direct_.rays) + bounced_.light[i] / float(bounced_.rays);
    return sum;
}

}  // namespace lumel::bench
