#include "atlas/charts/split.h"

#include <span>

#include "atlas/charts/flatten.h"

namespace lumel {

namespace {

// A chart that fills this share of its rectangle stays whole.
constexpr double kGoodFill = 0.5;
// Minimum share of texels that splitting must save, as it adds seams.
constexpr double kWorthSplitting = 0.25;
// Bounds the work; a ring ends up as at most 2^kMaxDepth arcs.
constexpr int kMaxDepth = 10;
// Maximum number of groups to test in pairs.
constexpr std::size_t kMaxRejoined = 128;

struct ChartBox {
    glm::dvec2 low{1e300}, high{-1e300};

    void add(const ChartBox& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

/// A triangle to be assigned to a half.
struct Item {
    std::uint32_t index;
    ChartBox box;
    double area;
};

using Groups = std::vector<std::vector<std::uint32_t>>;

struct Division {
    Groups groups;
    double cost = 0.0;
};

void sort_along(std::span<Item> items, int axis)
{
    std::sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
        const double centre_a = a.box.low[axis] + a.box.high[axis];
        const double centre_b = b.box.low[axis] + b.box.high[axis];
        return centre_a < centre_b || (centre_a == centre_b && a.index < b.index);
    });
}

struct Cut {
    int axis = 0;
    std::size_t position = 0;  ///< items before it are in the first half
    double cost = 1e300;
};

/// The straight cut across the rectangle with the lowest cost of both halves.
Cut best_cut(std::span<Item> items, const ChartCost& cost)
{
    Cut best;
    std::vector<double> cost_after(items.size());
    for (int axis = 0; axis < 2; ++axis) {
        sort_along(items, axis);
        ChartBox after, before;
        for (std::size_t i = items.size(); i-- > 0;) {
            after.add(items[i].box);
            cost_after[i] = cost(after.high - after.low);
        }
        for (std::size_t i = 1; i < items.size(); ++i) {
            before.add(items[i - 1].box);
            const double sum = cost(before.high - before.low) + cost_after[i];
            if (sum < best.cost)
                best = {axis, i, sum};
        }
    }
    return best;
}

Division divide(std::span<Item> items, const ChartCost& cost, int depth)
{
    ChartBox box;
    double area = 0.0;
    Division whole{{{}}, 0.0};
    for (const Item& item : items) {
        box.add(item.box);
        area += item.area;
        whole.groups[0].push_back(item.index);
    }
    const glm::dvec2 size = box.high - box.low;
    whole.cost = cost(size);
    if (items.size() < 2 || depth == kMaxDepth || area > kGoodFill * size.x * size.y)
        return whole;

    const Cut cut = best_cut(items, cost);
    sort_along(items, cut.axis);
    Division first = divide(items.first(cut.position), cost, depth + 1);
    Division second = divide(items.subspan(cut.position), cost, depth + 1);
    if (first.cost + second.cost > (1.0 - kWorthSplitting) * whole.cost)
        return whole;
    first.cost += second.cost;
    for (std::vector<std::uint32_t>& group : second.groups)
        first.groups.push_back(std::move(group));
    return first;
}

/// Joins groups that cost less together: a straight cut may have separated the two triangles of one
/// bar.
void rejoin(Groups& groups, const std::vector<Item>& items, const ChartCost& cost)
{
    std::vector<ChartBox> boxes(items.size());
    for (const Item& item : items)
        boxes[item.index] = item.box;
    std::vector<ChartBox> bounds(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::uint32_t index : groups[g])
            bounds[g].add(boxes[index]);
    const auto cost_of = [&](const ChartBox& box) { return cost(box.high - box.low); };
    for (std::size_t a = 0; a < groups.size(); ++a)
        for (std::size_t b = a + 1; b < groups.size();) {
            ChartBox both = bounds[a];
            both.add(bounds[b]);
            if (groups.size() > kMaxRejoined ||
                cost_of(both) > cost_of(bounds[a]) + cost_of(bounds[b])) {
                ++b;
                continue;
            }
            groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
            bounds[a] = both;
            groups.erase(groups.begin() + std::ptrdiff_t(b));
            bounds.erase(bounds.begin() + std::ptrdiff_t(b));
            b = a + 1;
        }
}

}  // namespace

double ChartCost::operator()(const glm::dvec2& size) const
{
    const glm::dvec2 texels = glm::max(size * texels_per_metre, glm::dvec2(1.0)) + double(gutter);
    return texels.x * texels.y;
}

std::vector<std::vector<std::uint32_t>> split_sparse(const std::vector<Polygon>& triangles,
                                                     const ChartCost& cost)
{
    std::vector<glm::dvec2> corners;
    for (const Polygon& triangle : triangles)
        corners.insert(corners.end(), triangle.corner.begin(), triangle.corner.begin() + 3);
    turn_to_tight_rectangle(corners);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::dvec2* corner = &corners[3 * i];
        items.push_back({i,
                         {glm::min(corner[0], glm::min(corner[1], corner[2])),
                          glm::max(corner[0], glm::max(corner[1], corner[2]))},
                         triangles[i].area()});
    }
    std::vector<Item> order = items;
    Groups groups = divide(order, cost, 0).groups;
    if (groups.size() > 1)
        rejoin(groups, items, cost);
    return groups;
}

}  // namespace lumel
