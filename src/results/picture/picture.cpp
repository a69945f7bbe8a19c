#include "results/picture/picture.h"

#include <numbers>

#include "base/core/parallel.h"

namespace lumel {
namespace {

constexpr std::size_t kPointsPerTask = 1024;

}  // namespace

Image compose(const Seen& seen, const LitScene& lit, std::span<const glm::vec3> reflected)
{
    Image image(seen.width, seen.height, 4);
    const std::size_t pixels = std::size_t(seen.width) * std::size_t(seen.height);
    const float share = 1.0f / float(seen.sets);
    const auto add = [&](std::size_t pixel, const glm::vec3& radiance) {
        for (int c = 0; c < 3; ++c)
            image.values[pixel * 4 + std::size_t(c)] += share * radiance[c];
    };
    parallel_for(pixels, kPointsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t set = 0; set < seen.sets; ++set) {
                const SeenPoint& point = seen.points[set * pixels + i];
                if (!point.there && !point.sky)
                    continue;
                add(i, point.luminance);
                if (point.there)
                    add(i,
                        point.diffuse * lit.irradiance(point.hit) * std::numbers::inv_pi_v<float>);
                image.values[i * 4 + 3] += share;
            }
    });
    for (std::size_t g = 0; g < seen.glossy.size(); ++g)
        add(seen.index[g] % pixels, reflected[g]);
    return image;
}

}  // namespace lumel
