// Daylight coefficients [TW83] of lumels. Direct light of patch k of the sky, by R rays of density
// cosθ / π, and of the sun at position s by shadow rays, with the transmittance τ of glass:
//
//     D_k = π/R Σ τ over the rays that leave through k,        D_s = τ cosθ_s
//
// The links of LinkRadiosity carry both from lumel to lumel, kLampLanes of them at once:
//
//     B = ρ (D + X)

#include "results/daylight/reflected_daylight.h"

#include <cmath>

#include "atlas/cells/ray_origins.h"
#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "base/core/usage.h"
#include "links/trace/links.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

constexpr std::size_t kDaylitPerStep = 2048, kDaylitPerTask = 64, kLanesPerTask = 4096;
/// Fraction of the work that direct light takes, for the progress bar only.
constexpr double kDirectPart = 0.5;
/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kStartPair = 0, kWayPair = 1, kGlassPair = 2;

class DirectDaylight {
public:
    DirectDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                   const ReflectedDaylightOptions& options)
        : scene_(scene),
          places_(places),
          options_(options),
          world_(scene.scene, scene.rays, scene.lumels),
          starts_(world_, nullptr, false),
          sun_rays_(std::uint32_t(
              std::ceil(double(options.sun_rays) / double(scene.lumels.lumels.size() + 1)))),
          count_(patches_.count() + places.size())
    {
    }

    std::size_t count() const { return count_; }

    /// Adds the direct light of a lumel to `light` [count()].
    void add(std::size_t lumel, glm::vec3* light) const
    {
        const std::uint32_t stream = PathSamples::hash(
            options_.seed, lumel_key(scene_.lumels.lumels[lumel], scene_.lumels.width));
        for (std::uint32_t k = 0; k < options_.sky_rays; ++k)
            add_sky(lumel, PathSamples(stream, k), light);
        for (std::uint32_t s = 0; s < places_.size(); ++s)
            light[patches_.count() + s] += sun(lumel, s, stream);
    }

private:
    glm::vec3 sun(std::size_t lumel, std::uint32_t place, std::uint32_t stream) const
    {
        const std::uint32_t own = PathSamples::hash(stream, place + 1);
        glm::vec3 sum(0.0f);
        for (std::uint32_t k = 0; k < sun_rays_; ++k)
            sum += sun_by(lumel, places_[place], PathSamples(own, k));
        return sum / float(sun_rays_);
    }

    glm::vec3 sun_by(std::size_t lumel, const glm::vec3& place, const PathSamples& samples) const
    {
        const RayOrigin start = starts_.start(lumel, samples.stratified(kStartPair));
        const float cosine = start.cosine(place);
        return cosine > 0.0f ? cosine * scene_.rays.transmittance_out(start.position, place,
                                                                      samples.bits(kGlassPair))
                             : glm::vec3(0.0f);
    }

    void add_sky(std::size_t lumel, const PathSamples& samples, glm::vec3* light) const
    {
        const RayOrigin start = starts_.start(lumel, samples.stratified(kStartPair));
        const glm::vec3 direction =
            frame_about(start.normal) * by_cosine(samples.stratified(kWayPair));
        const std::uint32_t patch = patches_.at(direction);
        if (patch != SkyPatches::kNone && start.cosine(direction) > 0.0f)
            light[patch] +=
                kPi / float(options_.sky_rays) *
                scene_.rays.transmittance_out(start.position, direction, samples.bits(kGlassPair));
    }

    const SolveScene& scene_;
    std::span<const glm::vec3> places_;
    const ReflectedDaylightOptions& options_;
    SkyPatches patches_;
    WorldLumels world_;
    RayOrigins starts_;
    std::uint32_t sun_rays_;  ///< of a lumel to a position of the sun
    std::size_t count_;
};

void check_memory(std::size_t lumels, std::size_t count)
{
    const std::uint64_t free = available_memory_bytes();
    // Beside them, the links and the light in sub-lumels of some sources.
    constexpr std::uint64_t kOthers = 2;
    const std::uint64_t needed = kOthers * lumels * count * sizeof(glm::vec3);
    constexpr std::uint64_t kMebibyte = 1u << 20u;
    if (free > 0 && needed > free)
        throw Error(ErrorKind::input, "--weather",
                    "needs about " + std::to_string(needed / kMebibyte) +
                        " MiB of memory for this bake; bake the scene with a smaller --size");
}

}  // namespace

ReflectedDaylight::ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                                     const ReflectedDaylightOptions& options,
                                     const std::function<bool(double)>& progress)
{
    const std::size_t lumels = scene.lumels.lumels.size();
    const DirectDaylight direct(scene, places, options);
    count_ = direct.count();
    check_memory(lumels, count_);
    sent_.assign(lumels * count_, glm::vec3(0.0f));
    const auto is_open = [&](std::size_t i) {
        return !(scene.lumels.lumels[i].flags & kLumelBuried);
    };
    const auto goes_on = [&](double part) { return !progress || progress(part); };
    if (!parallel_steps(
            lumels, kDaylitPerStep, kDaylitPerTask,
            [&](std::size_t from, std::size_t to) {
                for (std::size_t i = from; i < to; ++i)
                    if (is_open(i))
                        direct.add(i, &sent_[i * count_]);
            },
            [&](std::size_t done) { return goes_on(kDirectPart * double(done) / double(lumels)); }))
        return;

    // Links, whatever the light.
    LinkRadiosity links(scene,
                        LinksOptions{.seed = options.seed,
                                     .filter = false,
                                     .even_rays = options.link_rays,
                                     .outside_light = true},
                        {});
    while (!links.state().ended) {
        if (!goes_on(kDirectPart))
            return;
        links.step();
    }

    std::vector<glm::vec3> lanes(lumels * kLampLanes);
    for (std::size_t first = 0; first < count_; first += kLampLanes) {
        if (!goes_on(kDirectPart + (1.0 - kDirectPart) * double(first) / double(count_)))
            return;
        const std::size_t width = std::min(kLampLanes, count_ - first);
        for (std::size_t i = 0; i < lumels; ++i)
            for (std::size_t lane = 0; lane < kLampLanes; ++lane)
                lanes[i * kLampLanes + lane] =
                    lane < width ? sent_[i * count_ + first + lane] : glm::vec3(0.0f);
        const std::vector<glm::vec3> bounced = links.reflected(lanes);
        parallel_for(lumels, kLanesPerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t lane = 0; lane < width; ++lane) {
                    glm::vec3& sent = sent_[i * count_ + first + lane];
                    sent = is_open(i) ? scene.lumels.lumels[i].albedo *
                                            (sent + bounced[i * kLampLanes + lane])
                                      : glm::vec3(0.0f);
                }
        });
    }
    is_complete_ = true;
}

}  // namespace lumel
