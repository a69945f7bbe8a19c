// Makes a lumel of every texel that a surface touches.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atlas/lumels/patch.h"
#include "atlas/lumels/sides.h"
#include "atlas/packing/atlas.h"
#include "atlas/packing/morton.h"
#include "base/core/parallel.h"

namespace lumel {

namespace {

// Parts below both limits are rounding at a triangle's edge.
constexpr double kThinPart = 1e-6;  // [texels²]
constexpr double kThinShare = 1e-3;
// Texels per task.
constexpr std::size_t kMadePerTask = 1024;
// Texels converted before they are collected: bounds temporary memory.
constexpr std::size_t kTexelsAtATime = 1 << 17;
// Parts of different charts in one texel are one surface if their normals are within 45 degrees.
const double kCosContinues = std::cos(glm::radians(45.0));
// Maximum number of corners for an exact diameter.
constexpr std::size_t kExactDiameter = 32;

/// Overlap of a triangle and a texel.
struct Touch {
    std::uint32_t texel;
    std::uint32_t surface;
    std::uint32_t triangle;
    float area;  ///< [texels²]
};

/// Calls visit(x, y, area) for every texel that the triangle overlaps.
template <typename Visit>
void for_each_texel(const TexelTriangle& triangle, int width, int height, Visit visit)
{
    const auto cell = [](double place, int count) {
        return int(std::clamp(std::floor(place), 0.0, double(count - 1)));
    };
    const Polygon& plane = triangle.plane;
    if (triangle.collapsed) {
        // Degenerate: assigned to the texel of its centre, unless it is a long line without
        // width, which is not a surface.
        const glm::dvec2 extent = plane.high() - plane.low();
        const glm::dvec2 centre = (plane.corner[0] + plane.corner[1] + plane.corner[2]) / 3.0;
        if (std::max(extent.x, extent.y) < 1.0)
            visit(cell(centre.x, width), cell(centre.y, height), plane.area());
        return;
    }
    const double thin = std::min(kThinPart, kThinShare * plane.area());
    const int last_row = cell(std::ceil(plane.high().y) - 1.0, height);
    for (int y = cell(plane.low().y, height); y <= last_row; ++y) {
        const Polygon strip = clip_to_slab(plane, 1, y, y + 1);
        if (strip.count < 3)
            continue;
        const int last_column = cell(std::ceil(strip.high().x) - 1.0, width);
        for (int x = cell(strip.low().x, width); x <= last_column; ++x) {
            const double area = clip_to_slab(strip, 0, x, x + 1).area();
            if (area > thin)
                visit(x, y, area);
        }
    }
}

/// All touches, ordered by texel, then by surface and triangle.
std::vector<Touch> find_touches(const Scene& scene, const Atlas& atlas)
{
    std::vector<std::vector<Touch>> found(atlas.surfaces.size());
    parallel_for(atlas.surfaces.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
            const Surface& surface = atlas.surfaces[s];
            for (std::uint32_t t = 0; t < surface.chart.size(); ++t) {
                const TexelTriangle triangle(scene, surface, t);
                if (!(triangle.world_area > 0.0))
                    continue;
                for_each_texel(triangle, atlas.width, atlas.height, [&](int x, int y, double area) {
                    found[s].push_back(
                        {std::uint32_t(y * atlas.width + x), std::uint32_t(s), t, float(area)});
                });
            }
        }
    });

    // Counting sort: stable, so the order within a texel is that of the surfaces.
    std::vector<std::size_t> start(std::size_t(atlas.width) * atlas.height + 1, 0);
    for (const std::vector<Touch>& touches : found)
        for (const Touch& touch : touches)
            ++start[touch.texel + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Touch> sorted(start.back());
    for (std::vector<Touch>& touches : found) {
        for (const Touch& touch : touches)
            sorted[start[touch.texel]++] = touch;
        touches = {};
    }
    return sorted;
}

/// The touches of a texel.
struct TexelTouches {
    std::uint32_t first, last;  ///< range of touches
    std::uint32_t chart;        ///< with the largest area in the texel
};

std::uint32_t chart_of(const Atlas& atlas, const Touch& touch)
{
    return atlas.surfaces[touch.surface].chart[touch.triangle];
}

/// The chart with the largest part of a texel; the lowest index among equals. Only charts of the
/// file may share a texel.
std::uint32_t main_chart(const Atlas& atlas, const std::vector<Touch>& touches, std::uint32_t first,
                         std::uint32_t last)
{
    const std::uint32_t chart = chart_of(atlas, touches[first]);
    if (std::all_of(touches.begin() + first, touches.begin() + last,
                    [&](const Touch& touch) { return chart_of(atlas, touch) == chart; }))
        return chart;
    std::vector<std::pair<std::uint32_t, double>> areas;
    for (std::uint32_t i = first; i < last; ++i)
        areas.push_back({chart_of(atlas, touches[i]), touches[i].area});
    std::stable_sort(areas.begin(), areas.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::pair<std::uint32_t, double> best{0, -1.0};
    for (std::size_t i = 0, next; i < areas.size(); i = next) {
        double sum = 0.0;
        for (next = i; next < areas.size() && areas[next].first == areas[i].first; ++next)
            sum += areas[next].second;
        if (sum > best.second)
            best = {areas[i].first, sum};
    }
    return best.first;
}

/// Covered texels in lumel order: by chart, then along a Morton curve.
std::vector<TexelTouches> order_texels(const Atlas& atlas, const std::vector<Touch>& touches)
{
    std::vector<TexelTouches> texels;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;  // Morton code, index of texel
    for (std::uint32_t first = 0, last; first < touches.size(); first = last) {
        const std::uint32_t texel = touches[first].texel;
        for (last = first; last < touches.size() && touches[last].texel == texel;)
            ++last;
        const std::uint32_t width = std::uint32_t(atlas.width);
        keys.push_back({morton_code(texel % width, texel / width), std::uint32_t(texels.size())});
        texels.push_back({first, last, main_chart(atlas, touches, first, last)});
    }
    std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
        const std::uint32_t chart_a = texels[a.second].chart, chart_b = texels[b.second].chart;
        return chart_a < chart_b || (chart_a == chart_b && a < b);
    });
    std::vector<TexelTouches> ordered;
    ordered.reserve(texels.size());
    for (const auto& key : keys)
        ordered.push_back(texels[key.second]);
    return ordered;
}

/// Largest distance between two points; for many points, a close lower bound.
double diameter(const std::vector<glm::dvec3>& points)
{
    double longest = 0.0;
    if (points.size() <= kExactDiameter) {
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                longest = std::max(longest, glm::distance(points[i], points[j]));
        return longest;
    }
    // Goes to the farthest point, repeatedly.
    std::size_t from = 0, to = 0;
    for (int walk = 0; walk < 3; ++walk, from = to)
        for (std::size_t i = 0; i < points.size(); ++i)
            if (const double length = glm::distance(points[from], points[i]); length > longest) {
                longest = length;
                to = i;
            }
    return longest;
}

/// A texel's front lumel with its pieces, or none.
struct Lifted {
    Lumel lumel{};
    Gloss gloss{};
    float edge = 0.0f;
    std::vector<Piece> pieces;
    float coverage = 0.0f;
};

bool is_double_sided(const Scene& scene, const Atlas& atlas, const std::vector<Touch>& touches,
                     const TexelTouches& texel)
{
    for (std::uint32_t i = texel.first; i < texel.last; ++i)
        if (chart_of(atlas, touches[i]) == texel.chart) {
            const Surface& surface = atlas.surfaces[touches[i].surface];
            const Mesh& mesh = scene.meshes[scene.instances[surface.instance].mesh];
            return scene.materials[mesh.primitives[surface.primitive].material].double_sided;
        }
    return false;
}

/// True if a part of another chart continues the main part: charts of the file may be adjacent
/// without a gap inside a texel.
bool continues(const Part& main, const Part& other, int x, int y)
{
    if (main.surface->instance != other.surface->instance || main.triangle.collapsed ||
        glm::dot(main.triangle.front, other.triangle.front) < kCosContinues)
        return false;
    const double texel_diagonal =
        glm::distance(main.position(glm::dvec2(x, y)), main.position(glm::dvec2(x + 1, y + 1)));
    return glm::distance(main.position(main.polygon.centroid()),
                         other.position(other.polygon.centroid())) < 2.0 * texel_diagonal;
}

/// The texel's square clipped to the triangles of its main chart and its continuations.
std::vector<Part> clip_to_texel(const Scene& scene, const Atlas& atlas,
                                const std::vector<Touch>& touches, const TexelTouches& texel,
                                double& covered)
{
    const std::uint32_t index = touches[texel.first].texel, width = std::uint32_t(atlas.width);
    const int x = int(index % width), y = int(index / width);
    std::vector<Part> parts;
    covered = 0.0;
    for (const bool main : {true, false})
        for (std::uint32_t i = texel.first; i < texel.last; ++i) {
            if ((chart_of(atlas, touches[i]) == texel.chart) != main)
                continue;
            const Part part =
                make_part(scene, atlas.surfaces[touches[i].surface], touches[i].triangle, x, y);
            if (!main && !continues(parts.front(), part, x, y))
                continue;
            parts.push_back(part);
            covered += touches[i].area;
        }
    return parts;
}

Lifted lift_texel(const Scene& scene, const Atlas& atlas, const std::vector<Touch>& touches,
                  const TexelTouches& texel)
{
    const std::uint32_t index = touches[texel.first].texel, width = std::uint32_t(atlas.width);
    const int x = int(index % width), y = int(index / width);
    double covered = 0.0;
    const std::vector<Part> parts = clip_to_texel(scene, atlas, touches, texel, covered);

    // Measures position, area and extent.
    const Instance& instance = scene.instances[parts.front().surface->instance];
    const glm::dmat3 to_world(instance.transform);
    double area = 0.0;
    glm::dvec3 position(0.0), normal(0.0);
    std::vector<glm::dvec3> corners;
    double edge = 0.0;
    for (const Part& part : parts) {
        const glm::dvec2 centre = part.polygon.centroid();
        for (int k = 0; k < 3; ++k)
            edge = std::max(edge, glm::length(to_world * (part.triangle.corner[(k + 1) % 3] -
                                                          part.triangle.corner[k])));
        area += part.world_area;
        position += part.world_area * part.position(centre);
        normal += part.world_area * normal_at(part, centre);
        for (int i = 0; i < part.polygon.count; ++i)
            corners.push_back(to_world * part.position(part.polygon.corner[i]));
    }
    Lifted result;
    const Look look = mean_look(scene, parts, x, y);
    if (!(area > 0.0) || !(look.opacity > 0.0))
        return result;

    result.pieces = cut_into_pieces(parts, x, y);
    result.edge = float(edge);
    result.coverage = float(std::min(covered, 1.0) * look.opacity);
    Lumel& lumel = result.lumel;
    // The centroid of a bent lumel may be off the surface, even inside the wall.
    lumel.position =
        result.pieces.size() > 1 ? nearest_on(result.pieces, position / area) : position / area;
    lumel.normal = glm::length(normal) > 1e-3 * area ? glm::normalize(normal)
                                                     : glm::dvec3(result.pieces.front().normal);
    lumel.area = float(area * look.opacity);
    lumel.size =
        float(std::max(std::sqrt(double(lumel.area)), diameter(corners) / std::numbers::sqrt2));
    lumel.albedo = glm::clamp(look.albedo, 0.0, 1.0);
    lumel.emission = std::numbers::pi * look.luminance;
    result.gloss = {glm::clamp(look.diffuse, 0.0, 1.0), glm::clamp(look.specular, 0.0, 1.0),
                    shininess_of(look.roughness)};
    lumel.instance = parts.front().surface->instance;
    lumel.chart = texel.chart;
    lumel.texel = index;
    return result;
}

void append_front(const Lifted& lifted, Lumels& lumels)
{
    Lumel lumel = lifted.lumel;
    lumel.first_piece = std::uint32_t(lumels.pieces.size());
    lumel.piece_count = std::uint32_t(lifted.pieces.size());
    lumels.lumels.push_back(lumel);
    lumels.gloss.push_back(lifted.gloss);
    lumels.edge.push_back(lifted.edge);
    lumels.pieces.insert(lumels.pieces.end(), lifted.pieces.begin(), lifted.pieces.end());
}

/// Adds the back sides of the lumels from `first` on.
void append_backs(std::size_t first, Lumels& lumels)
{
    const std::size_t last = lumels.lumels.size();
    for (std::size_t i = first; i < last; ++i) {
        Lumel lumel = lumels.lumels[i];
        const std::uint32_t front_piece = lumel.first_piece;
        lumel.first_piece = std::uint32_t(lumels.pieces.size());
        lumel.flags = kLumelBack;
        lumel.normal = -lumel.normal;
        lumels.lumels.push_back(lumel);
        lumels.coverage[map_texel(lumels, lumel)] = lumels.coverage[lumel.texel];
        lumels.gloss.push_back(Gloss(lumels.gloss[i]));
        lumels.edge.push_back(float(lumels.edge[i]));
        for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
            Piece piece = lumels.pieces[front_piece + p];
            std::swap(piece.edge_u, piece.edge_v);
            piece.normal = -piece.normal;
            lumels.pieces.push_back(piece);
        }
    }
}

}  // namespace

Lumels make_lumels(const Scene& scene, const Atlas& atlas, const ProgressCallback& progress)
{
    Lumels lumels;
    lumels.width = atlas.width;
    lumels.height = atlas.height;
    lumels.coverage.assign(std::size_t(atlas.width) * atlas.height, 0.0f);
    lumels.back_shift = atlas.back_shift;
    lumels.shows_front = atlas.shows_front;
    const std::vector<Touch> touches = find_touches(scene, atlas);
    const std::vector<TexelTouches> texels = order_texels(atlas, touches);

    // Converts texels in parallel, in blocks; collects them in order, each chart's fronts, then its
    // backs. A chart has one material.
    std::vector<Lifted> lifted;
    std::size_t chart_first = 0;
    for (std::size_t first = 0; first < texels.size(); first += kTexelsAtATime) {
        notify(progress, double(first) / double(texels.size()));
        lifted.assign(std::min(kTexelsAtATime, texels.size() - first), {});
        parallel_for(lifted.size(), kMadePerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                lifted[i] = lift_texel(scene, atlas, touches, texels[first + i]);
        });
        for (std::size_t i = 0; i < lifted.size(); ++i) {
            const TexelTouches& texel = texels[first + i];
            lumels.coverage[touches[texel.first].texel] = lifted[i].coverage;
            if (!lifted[i].pieces.empty())
                append_front(lifted[i], lumels);
            const bool chart_ends =
                first + i + 1 == texels.size() || texels[first + i + 1].chart != texel.chart;
            if (chart_ends && is_double_sided(scene, atlas, touches, texel))
                append_backs(chart_first, lumels);
            if (chart_ends)
                chart_first = lumels.lumels.size();
        }
    }
    return lumels;
}

std::vector<std::uint32_t> lumels_by_side(const Lumels& lumels)
{
    std::vector<std::uint32_t> lumel_of(2 * std::size_t(lumels.width) * std::size_t(lumels.height),
                                        kNoLumel);
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        lumel_of[place_by_side(lumels.lumels[i])] = std::uint32_t(i);
    return lumel_of;
}

}  // namespace lumel
