// Light from infinity.
//
//   [VG95] E. Veach, L. Guibas. Optimally Combining Sampling Techniques. 1995.
//
// All lumels use a direction at once: one depth image of the scene shows which of them it reaches.
// The sky is an integral over directions,
//
//     H = ∫ L(ω) V(ω) cosθ dω  ≈  Σ_k  L(ω_k) / (p(ω_k) n) · V cosθ,
//
// with the same n directions ω_k for all lumels, sampled with density p.

#include "raster/shadow_maps/parallel_light.h"

#include <algorithm>
#include <cmath>

#include "base/core/frame.h"
#include "base/core/lattice.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"

namespace lumel {
namespace {

/// Keys of the samples, see lattice_point.
constexpr std::uint32_t kBrightKey = 1, kEvenKey = 2, kDiscKey = 3, kTurnKey = 4, kOffsetKey = 5;
/// Keys of one seed.
constexpr std::uint32_t kKeys = 8;

/// Maximum views per batch.
constexpr std::uint64_t kMaxViews = 64;

/// Views per batch.
std::uint32_t batch_of(const ParallelLightOptions& options)
{
    const std::uint64_t fit = kMaxLightPixels / (std::uint64_t(options.side) * options.side);
    return std::uint32_t(std::clamp<std::uint64_t>(fit, 1, kMaxViews));
}

ParallelView view_of(const ParallelSource& source, std::uint32_t index, std::uint32_t channel,
                     const World& world, const ParallelLightOptions& options)
{
    const std::uint32_t keys = options.seed * kKeys;
    // Images of equal orientation have evenly distributed pixel offsets.
    const ParallelPose pose{.toward = source.toward,
                            .turn = 2.0f * kPi * sequence_point(0, keys + kTurnKey).x,
                            .offset = sequence_point(index, keys + kOffsetKey),
                            .random = index + options.seed * 0x9e3779b9u,
                            .channel = channel};
    return fit_view(world.low(), world.high(), options.side, pose);
}

std::uint32_t views_per_source(const World& world)
{
    return world.has_coloured_glass() ? kChannels : 1;
}

/// One view per source, or with coloured glass three that differ by channel.
std::vector<ParallelView> views_of(const std::vector<ParallelSource>& sources, const World& world,
                                   const ParallelLightOptions& options)
{
    std::vector<ParallelView> views;
    for (std::uint32_t i = 0; i < std::uint32_t(sources.size()); ++i)
        if (!world.has_coloured_glass())
            views.push_back(view_of(sources[i], i, kAllChannels, world, options));
        else
            for (std::uint32_t c = 0; c < kChannels; ++c)
                views.push_back(view_of(sources[i], i, 1 + c, world, options));
    return views;
}

}  // namespace

std::vector<ParallelSource> sky_sources(const Sky& sky, std::uint32_t count, std::uint32_t seed)
{
    std::vector<ParallelSource> sources;
    if (sky.empty() || count == 0)
        return sources;
    const SkySampler sampler(sky);
    if (sampler.empty())
        return sources;
    constexpr float kEven = 0.25f / kPi;  // density of uniform directions [1/sr]
    const std::uint32_t half = std::max(count / 2, 1u);
    const auto add = [&](const glm::vec3& toward, const glm::vec3& radiance, float density) {
        // Balance heuristic: the combined density of both techniques.
        sources.push_back({toward, radiance / ((density + kEven) * float(half))});
    };
    for (std::uint32_t i = 0; i < half; ++i) {
        const SkySample bright = sampler.sample(lattice_point(i, half, seed * kKeys + kBrightKey));
        add(bright.direction, bright.radiance, bright.density);
        const glm::vec3 even = in_cone(lattice_point(i, half, seed * kKeys + kEvenKey), kPi);
        const glm::vec3 toward(even.x, even.z, even.y);
        add(toward, sky_radiance(sky, toward), sampler.density(toward));
    }
    std::erase_if(sources, [](const auto& s) { return s.illuminance == glm::vec3(0.0f); });
    return sources;
}

std::vector<ParallelSource> sun_sources(const PunctualLight& light, std::uint32_t count,
                                        std::uint32_t seed)
{
    const glm::vec3 away = glm::normalize(glm::vec3(light.transform[2]));  // light along -z
    const glm::mat3 frame = frame_about(away);
    // A uniform disc gives this illuminance on a surface facing its centre: the mean cosine over a
    // cone is sin²α / 2(1 - cosα).
    const float cosine = std::cos(light.angle);
    const float mean_cosine = light.angle > 0.0f ? 0.5f * (1.0f + cosine) : 1.0f;
    const glm::vec3 each = light.color * (light.intensity / (float(count) * mean_cosine));
    std::vector<ParallelSource> sources;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 d = in_cone(lattice_point(i, count, seed * kKeys + kDiscKey), light.angle);
        sources.push_back({glm::normalize(frame * d), each});
    }
    return sources;
}

std::uint64_t parallel_light_pixels(const ParallelLightOptions& options)
{
    return std::uint64_t(batch_of(options)) * options.side * options.side;
}

ParallelLight::ParallelLight(const gpu::Device& device, const World& world,
                             const std::vector<ParallelSource>& sources,
                             const ParallelLightOptions& options, SummedLight& light)
    : world_(&world),
      options_(options),
      light_(&light),
      total_(std::uint32_t(sources.size()) * views_per_source(world)),
      views_per_source_(views_per_source(world)),
      views_(device, std::span<const ParallelView>(views_of(sources, world, options))),
      sources_(device, std::span<const ParallelSource>(sources)),
      images_(device, world, options.side, batch_of(options)),
      receive_(device),
      pacer_(device)
{
}

void ParallelLight::step(std::uint64_t pixels)
{
    const auto fit = std::uint32_t(
        std::max<std::uint64_t>(pixels / (std::uint64_t(options_.side) * options_.side), 1));
    const std::uint32_t begin = next_;
    const std::uint32_t count = std::min({fit, images_.capacity(), total_ - begin});
    images_.look_along(pacer_, views_, begin, count);
    pacer_.dispatch_parts("parallel light", light_->lumels(), kProbeLumels, receive_,
                          {.lumels = world_->lumels(),
                           .pieces = world_->pieces(),
                           .views = views_,
                           .sources = sources_,
                           .parallel_image = {images_.image(), images_.sampler()},
                           .sums = light_->sums()},
                          {.tiling = images_.layout(),
                           .first_view = begin,
                           .views = count,
                           .views_per_source = views_per_source_,
                           .seed = options_.seed,
                           .centre = options_.centre ? 1u : 0u});
    next_ += count;
    if (is_done())
        finish();
}

void ParallelLight::finish()
{
    light_->finish_source(pacer_);
    light_->finish(pacer_);
}

}  // namespace lumel
