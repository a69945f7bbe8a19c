#include "truth/reference_image.h"

#include "truth/averages.h"
#include "truth/path_tracer.h"

namespace lumel {

namespace {

/// Key of the random numbers of images, independent of those of maps.
constexpr std::uint32_t kImageKey = 1;

}  // namespace

Image reference_image(const Scene& scene, const RayScene& rays, const View& view,
                      const ReferenceImageOptions& options,
                      const std::function<bool(double)>& progress)
{
    const PathTracer tracer(scene, rays, options.max_bounces);
    const std::uint32_t key = PathSamples::hash(options.seed, kImageKey);
    const auto width = std::size_t(options.width), height = std::size_t(options.height);
    const auto estimate = [&](std::size_t i, std::uint32_t sample) {
        const PathSamples samples(PathSamples::hash(key, std::uint32_t(i)), sample);
        const glm::vec2 pixel(i % width, i / width);
        const glm::vec2 place = (pixel + samples.stratified(kStartPair)) / glm::vec2(width, height);
        const Ray ray = ray_through(view, place);
        const auto radiance = tracer.radiance(ray.origin, ray.direction, samples);
        return radiance ? glm::vec4(*radiance, 1.0f) : glm::vec4(0.0f);
    };
    const std::vector<glm::vec4> means =
        average(width * height, options.samples_per_pixel, estimate, progress);
    if (means.empty())
        return {};

    Image image(options.width, options.height, 4);
    for (std::size_t i = 0; i < means.size(); ++i)
        for (int c = 0; c < 4; ++c)
            image.values[4 * i + std::size_t(c)] = means[i][c];
    return image;
}

}  // namespace lumel
