#include "update/solution_file.h"

#include <algorithm>

#include "atlas/sides.h"
#include "core/error.h"
#include "images/image_files.h"

namespace lumel {
namespace {

constexpr const char *kBackLayer = "back", *kOpenLayer = "open", *kShiftLayer = "shift";

std::vector<glm::vec3> colors_of(const Image& image)
{
    std::vector<glm::vec3> colors;
    colors.reserve(image.values.size() / 4);
    for (std::size_t i = 0; i + 3 < image.values.size(); i += 4)
        colors.emplace_back(image.values[i], image.values[i + 1], image.values[i + 2]);
    return colors;
}

/// Where the map has the backs of the chart that a texel belongs to.
void set_shift(const Lumels& lumels, const Lumel& lumel, Image& image)
{
    float* shift = image.values.data() + std::size_t(lumel.texel) * 4;
    if (has_own_back(lumels.back_shift, lumel.chart))
        for (int c = 0; c < 2; ++c)
            shift[c] = float(lumels.back_shift[lumel.chart][c]);
    shift[2] = lumels.shows_front ? 1.0f : 0.0f;
}

StoredCharts charts_of(const Image& front, const Image& shift)
{
    StoredCharts charts;
    for (std::size_t i = 0; i + 3 < front.values.size(); i += 4) {
        const bool covered = front.values[i + 3] >= 1.0f;
        const std::uint32_t chart = covered ? std::uint32_t(front.values[i + 3]) - 1 : kNoChart;
        charts.of_texel.push_back(chart);
        if (!covered)
            continue;
        charts.shows_front |= shift.values[i + 2] > 0.0f;
        if (charts.back_shift.size() <= chart)
            charts.back_shift.resize(std::size_t(chart) + 1, glm::ivec2(0));
        charts.back_shift[chart] = {int(shift.values[i]), int(shift.values[i + 1])};
    }
    const bool none = std::all_of(charts.back_shift.begin(), charts.back_shift.end(),
                                  [](const glm::ivec2& s) { return s == glm::ivec2(0); });
    if (none)
        charts.back_shift.clear();
    return charts;
}

}  // namespace

void write_solution(const std::string& path, const Lumels& lumels,
                    const std::vector<glm::vec3>& irradiance, const std::vector<float>& open)
{
    Image front(lumels.width, lumels.height, 4), back = front, shares = front, shift = front;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        Image& side = lumel.flags & kLumelBack ? back : front;
        for (std::size_t c = 0; c < 3; ++c)
            side.values[std::size_t(lumel.texel) * 4 + c] = irradiance[i][int(c)];
        front.values[std::size_t(lumel.texel) * 4 + 3] = float(lumel.chart + 1);
        shares.values[std::size_t(lumel.texel) * 4 + (lumel.flags & kLumelBack ? 1 : 0)] = open[i];
        set_shift(lumels, lumel, shift);
    }
    const std::vector<Layer> layers = {{kBackLayer, std::move(back)},
                                       {kOpenLayer, std::move(shares)},
                                       {kShiftLayer, std::move(shift)}};
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
    return {.side = front.width,
            .charts = charts_of(front, read_exr(path, kShiftLayer)),
            .front = colors_of(front),
            .back = colors_of(back),
            .open = colors_of(read_exr(path, kOpenLayer))};
}

}  // namespace lumel
