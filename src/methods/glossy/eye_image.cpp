#include "methods/glossy/eye_image.h"

namespace lumel {
namespace {

/// Points in the first, timed dispatch (see gpu::Pacer).
constexpr std::uint32_t kProbePoints = 4096;

}  // namespace

EyeImage::EyeImage(const gpu::Device& device, Projection projection,
                   std::span<const EyePoint> points, std::span<const float> brightness,
                   const EyeSampling& sampling)
    : sampling_(sampling),
      brightness_(device, brightness),
      receive_(device, std::uint32_t(projection))
{
    for (std::size_t set = 0; set < sampling_.sets(); ++set) {
        const std::size_t begin = sampling_.first[set], count = sampling_.first[set + 1] - begin;
        points_.emplace_back(device, points.subspan(begin, count), "eye_image.points");
        sums_.emplace_back(device, std::span<const glm::vec3>(std::vector<glm::vec3>(count)),
                           "eye_image.sums");
    }
}

std::uint64_t EyeImage::most_points(const gpu::Device& device)
{
    return device.max_array_bytes() / sizeof(EyePoint);
}

void EyeImage::restart(gpu::Pacer& pacer)
{
    pacer.work("restart", [&](gpu::Commands& commands) {
        for (const auto& sums : sums_)
            commands.fill(sums.buffer());
    });
    iterations_ = 0;
}

void EyeImage::receive(gpu::Pacer& pacer, const EyeViews& views, const gpu::Array<Eye>& eyes,
                       const gpu::Array<GlossyShot>& shots, const gpu::Array<GlossyLobe>& lobes,
                       std::uint32_t count)
{
    const std::uint64_t set = iterations_++ % sampling_.sets();
    const auto points = std::uint32_t(points_[set].size());
    if (points == 0)
        return;
    EyeParams params{.views = views.layout(),
                     .shots = count,
                     .shooters = sampling_.shooters(),
                     .rays = float(sampling_.rays)};
    pacer.dispatch_parts("eye", points, kProbePoints, receive_,
                         {.lobes_sent = lobes,
                          .views = {views.image(), views.sampler()},
                          .points = points_[set],
                          .eyes = eyes,
                          .shots = shots,
                          .density = brightness_,
                          .sums = sums_[set]},
                         params);
}

std::vector<glm::vec3> EyeImage::radiance() const
{
    std::vector<glm::vec3> radiance;
    const std::uint64_t sets = sampling_.sets();
    for (std::uint64_t set = 0; set < sets; ++set) {
        const std::uint64_t met = iterations_ / sets + (set < iterations_ % sets ? 1 : 0);
        for (const glm::vec3& sum : sums_[set].download())
            radiance.push_back(met > 0 ? sum / float(met) : glm::vec3(0.0f));
    }
    return radiance;
}

}  // namespace lumel
