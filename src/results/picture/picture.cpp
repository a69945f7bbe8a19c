#include "results/picture/picture.h"

#include <algorithm>

#include "base/core/parallel.h"

namespace lumel {
namespace {

constexpr std::size_t kPointsPerTask = 1024;

void add(Image& image, std::size_t pixel, const glm::vec3& radiance)
{
    for (int c = 0; c < 3; ++c)
        image.values[pixel * 4 + std::size_t(c)] += radiance[c];
}

}  // namespace

std::vector<Image> compose(const Seen& seen, const LitScene& lit)
{
    const std::size_t layers = lit.layers();
    std::vector<Image> images(layers, Image(seen.width, seen.height, 4));
    const std::size_t pixels = std::size_t(seen.width) * std::size_t(seen.height);
    const float share = 1.0f / float(seen.sets);
    parallel_for(pixels, kPointsPerTask, [&](std::size_t first, std::size_t last) {
        std::vector<glm::vec3> light(layers);
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t set = 0; set < seen.sets; ++set) {
                const SeenPoint& point = seen.points[set * pixels + i];
                if (!point.there && !point.sky)
                    continue;
                std::ranges::fill(light, glm::vec3(0.0f));
                if (point.there)
                    lit.add_light(point.hit, point.luminance, point.diffuse, glm::vec3(1.0f),
                                  light);
                else
                    light[lit.sky_layer()] += point.luminance;
                for (std::size_t layer = 0; layer < layers; ++layer) {
                    add(images[layer], i, share * light[layer]);
                    images[layer].values[i * 4 + 3] += share;
                }
            }
    });
    return images;
}

void add_reflected(std::vector<Image>& images, const Seen& seen, std::size_t first,
                   std::span<const glm::vec3> reflected)
{
    const std::size_t pixels = std::size_t(seen.width) * std::size_t(seen.height);
    const float share = 1.0f / float(seen.sets);
    for (std::size_t v = 0; v < reflected.size(); ++v)
        add(images[v % images.size()], seen.index[first + v / images.size()] % pixels,
            share * reflected[v]);
}

}  // namespace lumel
