#include "solve/matrix/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace lumel {
namespace {

/// A unit normal's length, in diagonals of the box around all places: so that opposite walls are
/// about as far apart as the sides of an edge.
constexpr float kNormalWeight = 0.4f;

constexpr int kAxisIterations = 20;  // of the power method; any good axis will do

using Point = std::array<float, 6>;  // place, weighted normal

std::vector<Point> points_of(const Elements& elements)
{
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& place : elements.place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const float weight = kNormalWeight * glm::length(high - low);
    std::vector<Point> points;
    for (std::size_t i = 0; i < elements.place.size(); ++i) {
        const glm::vec3 p = elements.place[i], n = weight * elements.normal[i];
        points.push_back({p.x, p.y, p.z, n.x, n.y, n.z});
    }
    return points;
}

/// How far each point lies along the axis on which they spread most.
std::vector<double> along_main_axis(std::span<const Point> points,
                                    std::span<const std::uint32_t> ids)
{
    std::array<double, 6> mean{};
    for (const std::uint32_t id : ids)
        for (std::size_t d = 0; d < 6; ++d)
            mean[d] += double(points[id][d]) / double(ids.size());
    std::array<std::array<double, 6>, 6> covariance{};
    for (const std::uint32_t id : ids)
        for (std::size_t d = 0; d < 6; ++d)
            for (std::size_t e = 0; e < 6; ++e)
                covariance[d][e] +=
                    (double(points[id][d]) - mean[d]) * (double(points[id][e]) - mean[e]);
    std::array<double, 6> axis = {1.0, 0.9, 0.8, 0.7, 0.6, 0.5};
    for (int step = 0; step < kAxisIterations; ++step) {
        std::array<double, 6> next{};
        double length = 0.0;
        for (std::size_t d = 0; d < 6; ++d) {
            for (std::size_t e = 0; e < 6; ++e)
                next[d] += covariance[d][e] * axis[e];
            length = std::max(length, std::abs(next[d]));
        }
        if (length <= 0.0)
            break;
        for (std::size_t d = 0; d < 6; ++d)
            axis[d] = next[d] / length;
    }
    std::vector<double> along;
    for (const std::uint32_t id : ids) {
        double sum = 0.0;
        for (std::size_t d = 0; d < 6; ++d)
            sum += axis[d] * double(points[id][d]);
        along.push_back(sum);
    }
    return along;
}

void split(std::span<const Point> points, std::span<std::uint32_t> ids, std::uint32_t size)
{
    const std::size_t clusters = (ids.size() + size - 1) / size;
    if (clusters < 2)
        return;
    const std::vector<double> along = along_main_axis(points, ids);
    std::vector<std::uint32_t> order(ids.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return along[a] < along[b]; });
    std::vector<std::uint32_t> sorted;
    for (const std::uint32_t i : order)
        sorted.push_back(ids[i]);
    std::copy(sorted.begin(), sorted.end(), ids.begin());
    const std::size_t half = clusters / 2 * size;
    split(points, ids.first(half), size);
    split(points, ids.subspan(half), size);
}

}  // namespace

std::vector<std::uint32_t> cluster_order(const Elements& elements, std::uint32_t size)
{
    std::vector<std::uint32_t> order(elements.place.size());
    std::iota(order.begin(), order.end(), 0u);
    split(points_of(elements), order, size);
    return order;
}

}  // namespace lumel
