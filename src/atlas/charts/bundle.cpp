// Bundles: parts thinner than a texel, which would each need a chart and a gutter, share the
// texels of their neighbours. Examples: leaves, mouldings, the rungs of a chair.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "atlas/charts/layout.h"

namespace lumel {

namespace {

// Quantisation of directions: strips within about 7 degrees are parallel.
constexpr double kDirectionSteps = 8.0;
// Width of a bundle [texels], which rounds to one texel at densities near the expected one.
constexpr double kBundleWidth = 0.6;

/// A chart thinner than a texel.
struct Thin {
    std::uint32_t chart = 0;
    glm::dvec3 direction{0.0};    ///< unit, along a strip; zero: smaller than a texel
    double from = 0.0, to = 0.0;  ///< range of the strip along it [m]
    bool turned = false;          ///< its u axis is reversed
};

/// Type, facing, direction and cell. Charts of equal keys are bundled.
using Key = std::array<long long, 8>;

/// The vertices of each chart, and its normal.
struct ChartShape {
    std::vector<std::uint32_t> vertices;
    glm::dvec3 normal{0.0};
    glm::dvec3 centre{0.0};
};

std::vector<ChartShape> shapes_of(const Layout& layout, const std::vector<glm::dvec3>& positions)
{
    std::vector<ChartShape> shapes(layout.chart_size.size());
    for (std::uint32_t v = 0; v < layout.vertex_chart.size(); ++v) {
        ChartShape& shape = shapes[layout.vertex_chart[v]];
        shape.vertices.push_back(v);
        shape.centre += positions[layout.source_vertex[v]];
    }
    for (ChartShape& shape : shapes)
        shape.centre /= double(std::max<std::size_t>(shape.vertices.size(), 1));
    for (std::size_t t = 0; t < layout.chart.size(); ++t) {
        const glm::dvec3& a = positions[layout.source_vertex[layout.indices[3 * t]]];
        const glm::dvec3& b = positions[layout.source_vertex[layout.indices[3 * t + 1]]];
        const glm::dvec3& c = positions[layout.source_vertex[layout.indices[3 * t + 2]]];
        shapes[layout.chart[t]].normal += glm::cross(b - a, c - a);
    }
    return shapes;
}

/// Index of the closest of the six axis directions.
long long facing(const glm::dvec3& normal)
{
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (normal[axis] < 0.0);
}

/// Measures a strip along its direction, rounded so that neighbours agree.
Thin make_strip(std::uint32_t chart, const ChartShape& shape, const Layout& layout,
                const std::vector<glm::dvec3>& positions, Key& key)
{
    const auto along = [&](std::uint32_t a, std::uint32_t b) {
        return layout.place[a].x < layout.place[b].x;
    };
    const auto [first, last] =
        std::minmax_element(shape.vertices.begin(), shape.vertices.end(), along);
    const auto at = [&](std::uint32_t v) { return positions[layout.source_vertex[v]]; };
    glm::dvec3 steps = glm::round(glm::normalize(at(*last) - at(*first)) * kDirectionSteps);
    Thin strip{chart, {}, 1e300, -1e300, false};
    strip.turned = steps.x < 0.0 || (steps.x == 0.0 && steps.y < 0.0) ||
                   (steps.x == 0.0 && steps.y == 0.0 && steps.z < 0.0);
    if (strip.turned)
        steps = -steps;
    strip.direction = glm::normalize(steps);
    for (std::uint32_t v : shape.vertices) {
        strip.from = std::min(strip.from, glm::dot(at(v), strip.direction));
        strip.to = std::max(strip.to, glm::dot(at(v), strip.direction));
    }
    for (int i = 0; i < 3; ++i)
        key[2 + i] = std::llround(steps[i]);
    return strip;
}

std::map<Key, std::vector<Thin>> find_thin(const Layout& layout,
                                           const std::vector<ChartShape>& shapes,
                                           const std::vector<glm::dvec3>& positions, double density)
{
    std::map<Key, std::vector<Thin>> found;
    for (std::uint32_t chart = 0; chart < shapes.size(); ++chart) {
        const glm::dvec2 texels = layout.chart_size[chart] * density;
        if (texels.y >= 1.0)
            continue;
        Key key{};
        Thin thin{chart, {}, 0.0, 0.0, false};
        if (texels.x >= 1.0)
            thin = make_strip(chart, shapes[chart], layout, positions, key);
        const glm::dvec3 centre = shapes[chart].centre;
        const glm::dvec3 cell =
            glm::floor((centre - glm::dot(centre, thin.direction) * thin.direction) * density);
        key[0] = texels.x >= 1.0;
        key[1] = facing(shapes[chart].normal);
        for (int i = 0; i < 3; ++i)
            key[5 + i] = std::llround(cell[i]);
        found[key].push_back(thin);
    }
    return found;
}

/// Superimposes the charts first…last in one chart.
void lay_over(Layout& layout, const std::vector<ChartShape>& shapes,
              const std::vector<glm::dvec3>& positions, const Thin* first, const Thin* last,
              double width)
{
    const std::uint32_t target = first->chart;
    const bool strips = first->direction != glm::dvec3(0.0);
    double from = first->from, to = first->to;
    for (const Thin* thin = first; thin != last; ++thin) {
        from = std::min(from, thin->from);
        to = std::max(to, thin->to);
    }
    for (const Thin* thin = first; thin != last; ++thin) {
        const glm::dvec2 size = glm::max(layout.chart_size[thin->chart], glm::dvec2(1e-30));
        for (std::uint32_t v : shapes[thin->chart].vertices) {
            glm::dvec2 place = layout.place[v] / size;
            if (thin->turned)
                place = 1.0 - place;
            place *= width;
            if (strips)
                place.x = glm::dot(positions[layout.source_vertex[v]], thin->direction) - from;
            layout.place[v] = place;
            layout.vertex_chart[v] = target;
        }
    }
    layout.chart_size[target] = {strips ? to - from : width, width};
}

/// Removes gaps in the numbering of charts.
void renumber(Layout& layout)
{
    std::vector<std::uint32_t> number(layout.chart_size.size(), 0);
    for (std::uint32_t chart : layout.vertex_chart)
        number[chart] = 1;
    std::uint32_t count = 0;
    for (std::size_t chart = 0; chart < number.size(); ++chart)
        if (number[chart] != 0) {
            layout.chart_size[count] = layout.chart_size[chart];
            number[chart] = count++;
        }
    layout.chart_size.resize(count);
    for (std::uint32_t& chart : layout.vertex_chart)
        chart = number[chart];
    for (std::size_t t = 0; t < layout.chart.size(); ++t)
        layout.chart[t] = layout.vertex_chart[layout.indices[3 * t]];
}

}  // namespace

void bundle_thin_charts(Layout& layout, const std::vector<glm::dvec3>& positions, double density)
{
    if (!(density > 0.0))
        return;
    const std::vector<ChartShape> shapes = shapes_of(layout, positions);
    for (auto& [key, thin] : find_thin(layout, shapes, positions, density)) {
        std::vector<Thin> bundle = thin;
        std::stable_sort(bundle.begin(), bundle.end(),
                         [](const Thin& a, const Thin& b) { return a.from < b.from; });
        // Bundles strips that follow each other without a gap.
        for (std::size_t first = 0, last; first < bundle.size(); first = last) {
            double end = bundle[first].to;
            for (last = first + 1; last < bundle.size() && bundle[last].from <= end + 1.0 / density;
                 ++last)
                end = std::max(end, bundle[last].to);
            if (last - first > 1)
                lay_over(layout, shapes, positions, &bundle[first], bundle.data() + last,
                         kBundleWidth / density);
        }
    }
    renumber(layout);
}

}  // namespace lumel
