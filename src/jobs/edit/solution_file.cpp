#include "jobs/edit/solution_file.h"

#include <algorithm>
#include <cmath>

#include "atlas/finish/finish.h"
#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "base/images/image_files.h"
#include "results/record/bake_record.h"

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

/// Stores the position of the backs of the texel's chart.
void set_shift(const Lumels& lumels, const Lumel& lumel, Image& image)
{
    float* shift = image.values.data() + std::size_t(lumel.texel) * 4;
    if (has_own_back(lumels.back_shift, lumel.chart))
        for (int c = 0; c < 2; ++c)
            shift[c] = float(lumels.back_shift[lumel.chart][c]);
    shift[2] = lumels.shows_front ? 1.0f : 0.0f;
}

/// Of the lumels that the map shows, with gutters as there.
Image error_map(const Lumels& lumels, const std::vector<glm::vec3>& irradiance,
                const std::vector<float>& error)
{
    const std::vector<std::uint32_t> shown = shown_lumels(lumels, irradiance);
    Image map(lumels.width, lumels.height, 4);
    for (std::size_t texel = 0; texel < shown.size(); ++texel)
        if (shown[texel] != kNoLumel) {
            map.values[4 * texel] = error[shown[texel]];
            map.values[4 * texel + 3] = 1.0f;
        }
    fill_buried(map, lumels, shown);
    dilate(map);
    return map;
}

[[noreturn]] void fail_damaged(const std::string& path)
{
    throw Error(ErrorKind::input, path, "is damaged; bake the scene again");
}

/// An integer in [-most, most], or throws.
int whole(float value, int most, const std::string& path)
{
    if (!(std::abs(value) <= float(most)) || value != std::floor(value))
        fail_damaged(path);
    return int(value);
}

StoredCharts charts_of(const Image& front, const Image& shift, const std::string& path)
{
    const int side = front.width;
    StoredCharts charts;
    for (int texel = 0; texel < side * side; ++texel) {
        const float* number = front.values.data() + std::size_t(texel) * 4 + 3;
        const float* back = shift.values.data() + std::size_t(texel) * 4;
        const bool covered = *number != 0.0f;
        charts.of_texel.push_back(covered ? std::uint32_t(whole(*number, side * side, path) - 1)
                                          : kNoChart);
        if (!covered)
            continue;
        const std::uint32_t chart = charts.of_texel.back();
        const glm::ivec2 moved(whole(back[0], side, path), whole(back[1], side, path));
        const glm::ivec2 place = glm::ivec2(texel % side, texel / side) + moved;
        if (chart >= std::uint32_t(side * side) || glm::any(glm::lessThan(place, glm::ivec2(0))) ||
            glm::any(glm::greaterThanEqual(place, glm::ivec2(side))))
            fail_damaged(path);
        charts.shows_front |= back[2] > 0.0f;
        if (charts.back_shift.size() <= chart)
            charts.back_shift.resize(std::size_t(chart) + 1, glm::ivec2(0));
        charts.back_shift[chart] = moved;
    }
    const bool none = std::all_of(charts.back_shift.begin(), charts.back_shift.end(),
                                  [](const glm::ivec2& s) { return s == glm::ivec2(0); });
    if (none)
        charts.back_shift.clear();
    return charts;
}

}  // namespace

void write_solution(const std::string& path, const Lumels& lumels,
                    const std::vector<glm::vec3>& irradiance, const std::vector<float>& open,
                    const std::vector<float>& error)
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
    std::vector<Layer> layers;  // moved in: an initializer list would copy them
    layers.push_back({kBackLayer, std::move(back)});
    layers.push_back({kOpenLayer, std::move(shares)});
    layers.push_back({kShiftLayer, std::move(shift)});
    if (!error.empty())
        layers.push_back({kErrorLayer, error_map(lumels, irradiance, error)});
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
        throw Error(ErrorKind::input, path, "is not square: it was changed after the bake");
    return {.side = front.width,
            .charts = charts_of(front, read_exr(path, kShiftLayer), path),
            .front = colors_of(front),
            .back = colors_of(back),
            .open = colors_of(read_exr(path, kOpenLayer))};
}

}  // namespace lumel
