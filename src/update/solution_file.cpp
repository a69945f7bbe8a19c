#include "update/solution_file.h"

#include "core/error.h"
#include "images/image_files.h"

namespace lumel {
namespace {

constexpr const char *kBackLayer = "back", *kOpenLayer = "open";

std::vector<glm::vec3> colors_of(const Image& image)
{
    std::vector<glm::vec3> colors;
    colors.reserve(image.values.size() / 4);
    for (std::size_t i = 0; i + 3 < image.values.size(); i += 4)
        colors.emplace_back(image.values[i], image.values[i + 1], image.values[i + 2]);
    return colors;
}

}  // namespace

void write_solution(const std::string& path, const Lumels& lumels,
                    const std::vector<glm::vec3>& irradiance, const std::vector<float>& open)
{
    Image front(lumels.width, lumels.height, 4), back = front, shares = front;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        Image& side = lumel.flags & kLumelBack ? back : front;
        for (std::size_t c = 0; c < 3; ++c)
            side.values[std::size_t(lumel.texel) * 4 + c] = irradiance[i][int(c)];
        front.values[std::size_t(lumel.texel) * 4 + 3] = float(lumel.chart + 1);
        shares.values[std::size_t(lumel.texel) * 4 + (lumel.flags & kLumelBack ? 1 : 0)] = open[i];
    }
    const std::vector<Layer> layers = {{kBackLayer, std::move(back)},
                                       {kOpenLayer, std::move(shares)}};
    write_exr(path, front, Precision::float32,
              {{"quantity", "irradiance of lumels, before gutters and seams"},
               {"unit", "lx"},
               {"alpha", "number of the chart, from 1"}},
              layers);
}

StoredSolution read_solution(const std::string& path)
{
    const Image front = read_exr(path), back = read_exr(path, kBackLayer);
    if (front.width != front.height)
        throw Error(ErrorKind::input, path, "is not square: it is not as lumel bake wrote it");
    StoredSolution solution{.side = front.width,
                            .charts = {},
                            .front = colors_of(front),
                            .back = colors_of(back),
                            .open = colors_of(read_exr(path, kOpenLayer))};
    for (std::size_t i = 3; i < front.values.size(); i += 4)
        solution.charts.push_back(front.values[i] >= 1.0f ? std::uint32_t(front.values[i]) - 1
                                                          : kNoChart);
    return solution;
}

}  // namespace lumel
