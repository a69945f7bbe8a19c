#include "solve/eye_image.h"

namespace lumel {
namespace {

constexpr std::uint32_t kReceiveSpirv[] = {
#include "solve/eye_image.receive.comp.inc"
};

constexpr gpu::Slot kReceiveSlots[] = {
    gpu::Slot::array, gpu::Slot::constants, gpu::Slot::constants, gpu::Slot::texture,
    gpu::Slot::array, gpu::Slot::array,     gpu::Slot::array};

/// Points tried first when the work is timed (see gpu::Pacer).
constexpr std::uint32_t kProbePoints = 4096;

}  // namespace

EyeImage::EyeImage(const gpu::Device& device, Projection projection,
                   std::span<const EyePoint> points, std::span<const float> brightness,
                   const EyeSampling& sampling)
    : sampling_(sampling),
      points_(device, points),
      brightness_(device, brightness),
      sums_(device, std::span<const glm::vec3>(std::vector<glm::vec3>(points.size()))),
      receive_(device, "eye_image.receive", kReceiveSpirv, kReceiveSlots, sizeof(EyeParams),
               kEyeGroup, std::uint32_t(projection))
{
}

void EyeImage::receive(gpu::Pacer& pacer, const EyeViews& views, const gpu::Array<Eye>& eyes,
                       const gpu::Array<GlossyShot>& shots, const gpu::Array<GlossyLobe>& lobes,
                       std::uint32_t count)
{
    const std::uint64_t set = iterations_++ % sampling_.sets();
    const std::uint32_t begin = sampling_.first[set], end = sampling_.first[set + 1];
    if (begin == end)
        return;
    EyeParams params{.views = views.layout(),
                     .shots = count,
                     .shooters = sampling_.shooters(),
                     .rays = float(sampling_.rays)};
    pacer.work(
        "eye", end - begin, kProbePoints,
        [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
            params.first = begin + first;
            params.last = begin + last;
            commands.dispatch(
                receive_,
                {points_, eyes, shots, {views.image(), views.sampler()}, brightness_, sums_, lobes},
                params, last - first);
        });
}

std::vector<glm::vec3> EyeImage::radiance() const
{
    std::vector<glm::vec3> radiance = sums_.download();
    const std::uint64_t sets = sampling_.sets();
    for (std::uint64_t set = 0; set < sets; ++set) {
        const std::uint64_t met = iterations_ / sets + (set < iterations_ % sets ? 1 : 0);
        for (std::uint32_t e = sampling_.first[set]; e < sampling_.first[set + 1]; ++e)
            radiance[e] = met > 0 ? radiance[e] / float(met) : glm::vec3(0.0f);
    }
    return radiance;
}

}  // namespace lumel
