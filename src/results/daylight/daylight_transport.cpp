// Direct light by sky_rays.h; the links of LinkRadiosity carry it from lumel to lumel, kLampLanes
// sources at once.

#include "results/daylight/daylight_transport.h"

#include <cmath>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "base/core/usage.h"
#include "links/trace/links.h"
#include "results/daylight/sky_rays.h"
#include "scene/sky/sky_patches.h"

namespace lumel {
namespace {

constexpr std::size_t kDaylitPerStep = 2048, kDaylitPerTask = 64, kLanesPerTask = 4096;
/// Fraction of the constructor's work that direct light takes, for the progress bar only.
constexpr double kDirectPart = 0.7;

void check_memory(std::size_t lumels, std::size_t places, const char* asked_by)
{
    const std::uint64_t free = available_memory_bytes();
    const std::uint64_t needed = DaylightTransport::bytes(lumels, places);
    constexpr std::uint64_t kMebibyte = 1u << 20u;
    if (free > 0 && needed > free)
        throw Error(ErrorKind::input, asked_by,
                    "needs about " + std::to_string(needed / kMebibyte) +
                        " MiB of memory for this bake; bake the scene with a smaller --size");
}

}  // namespace

std::uint64_t DaylightTransport::bytes(std::size_t lumels, std::size_t places)
{
    // Beside the coefficients, the links and the light in sub-lumels of some sources.
    constexpr std::uint64_t kOthers = 2;
    return kOthers * lumels * (SkyPatches().count() + places) * sizeof(glm::vec3);
}

DaylightTransport::DaylightTransport(const SolveScene& scene, std::span<const glm::vec3> places,
                                     const DaylightTransportOptions& options,
                                     const std::function<bool(double)>& progress)
    : scene_(scene)
{
    const std::size_t lumels = scene.lumels.lumels.size();
    check_memory(lumels, places.size(), options.asked_by);
    const SkyPatches patches;
    const SkyRays rays(scene, options.sky_rays, options.seed);
    const auto sun_rays = std::uint32_t(std::ceil(double(options.sun_rays) / double(lumels + 1)));
    count_ = patches.count() + places.size();
    light_.assign(lumels * count_, glm::vec3(0.0f));
    const auto find = [&](std::size_t i) {
        glm::vec3* const light = &light_[i * count_];
        rays.visit(i, [&](const glm::vec3& direction, const glm::vec3& found) {
            if (const std::uint32_t patch = patches.at(direction); patch != SkyPatches::kNone)
                light[patch] += found;
        });
        for (std::uint32_t s = 0; s < places.size(); ++s)
            light[patches.count() + s] = rays.sun(i, places[s], s, sun_rays);
    };
    const auto goes_on = [&](double part) { return !progress || progress(part); };
    if (!parallel_steps(
            lumels, kDaylitPerStep, kDaylitPerTask,
            [&](std::size_t from, std::size_t to) {
                for (std::size_t i = from; i < to; ++i)
                    if (!(scene.lumels.lumels[i].flags & kLumelBuried))
                        find(i);
            },
            [&](std::size_t done) { return goes_on(kDirectPart * double(done) / double(lumels)); }))
        return;

    // Links, whatever the light.
    links_ = std::make_unique<LinkRadiosity>(scene,
                                             LinksOptions{.seed = options.seed,
                                                          .filter = false,
                                                          .even_rays = options.link_rays,
                                                          .outside_light = true},
                                             SolveLimits());
    while (!links_->state().ended) {
        if (!goes_on(kDirectPart))
            return;
        links_->step();
    }
    is_complete_ = true;
}

DaylightTransport::DaylightTransport(DaylightTransport&& from) noexcept = default;
DaylightTransport::~DaylightTransport() = default;

void DaylightTransport::reflect(const Kept& kept, const std::function<bool(double)>& progress)
{
    const std::size_t lumels = scene_.lumels.lumels.size();
    std::vector<glm::vec3> lanes(lumels * kLampLanes);
    for (std::size_t first = 0; first < count_; first += kLampLanes) {
        is_complete_ = is_complete_ && (!progress || progress(double(first) / double(count_)));
        if (!is_complete_)
            return;
        const std::size_t width = std::min(kLampLanes, count_ - first);
        for (std::size_t i = 0; i < lumels; ++i)
            for (std::size_t lane = 0; lane < kLampLanes; ++lane)
                lanes[i * kLampLanes + lane] =
                    lane < width ? light_[i * count_ + first + lane] : glm::vec3(0.0f);
        const std::vector<glm::vec3> bounced = links_->reflected(lanes);
        parallel_for(lumels, kLanesPerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t lane = 0; lane < width; ++lane) {
                    glm::vec3& light = light_[i * count_ + first + lane];
                    light = scene_.lumels.lumels[i].flags & kLumelBuried
                                ? glm::vec3(0.0f)
                                : kept(i, light, bounced[i * kLampLanes + lane]);
                }
        });
    }
}

}  // namespace lumel
