#include "jobs/edit/kept_atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atlas/lumels/sides.h"
#include "atlas/near/hit_lumels.h"
#include "base/core/error.h"

namespace lumel {
namespace {

/// Corners this close to a texel border lie on it: coordinates were stored relative to the side.
constexpr float kSnap = 1e-3f;  // [texels]

float snapped(float texel)
{
    const float border = std::round(texel);
    return std::abs(texel - border) < kSnap ? border : texel;
}

int page_of(const Scene& scene, const Primitive& primitive, std::uint32_t vertex)
{
    return primitive.lightmap_pages.empty()
               ? scene.materials[std::size_t(primitive.material)].lightmap_page
               : int(primitive.lightmap_pages[vertex]);
}

std::uint32_t chart_at(const Atlas& atlas, const StoredCharts& charts, const glm::vec2& texel)
{
    const auto cell = [](float at, int side) { return std::clamp(int(at), 0, side - 1); };
    return charts.of_texel[std::size_t(cell(texel.y, atlas.height)) * std::size_t(atlas.width) +
                           std::size_t(cell(texel.x, atlas.width))];
}

/// Charts of a surface's triangles, from the texels that they cover.
std::vector<std::uint32_t> charts_of(const Surface& surface, const Atlas& atlas,
                                     const StoredCharts& charts)
{
    std::vector<std::uint32_t> chart;
    for (std::size_t k = 0; k + 2 < surface.indices.size(); k += 3) {
        const glm::vec2& a = surface.texcoord[surface.indices[k]];
        const glm::vec2& b = surface.texcoord[surface.indices[k + 1]];
        const glm::vec2& c = surface.texcoord[surface.indices[k + 2]];
        chart.push_back(chart_at(atlas, charts, (a + b + c) / 3.0f));
    }
    return chart;
}

/// Surface of a primitive with the triangles of `kept`, in their order.
Surface moved_over(const Surface& kept, const Primitive& primitive, std::uint32_t instance)
{
    Surface surface = kept;
    surface.instance = instance;
    for (std::size_t k = 0; k < kept.indices.size(); ++k)
        surface.source_vertex[kept.indices[k]] = primitive.indices[k];
    return surface;
}

/// Texels of a square map without charts and gutters; finds free rectangles.
class Room {
public:
    Room(const Atlas& atlas, int gutter)
        : side_(atlas.width),
          page_side_(std::max(atlas.pages.side, 1)),
          sums_(std::size_t(side_ + 1) * std::size_t(side_ + 1), 0)
    {
        std::vector<char> taken(std::size_t(side_) * std::size_t(side_), 0);
        for (const Surface& surface : atlas.surfaces) {
            take_all(surface, gutter, taken);
            if (has_own_back(atlas, surface))
                take_all(own_back_of(atlas, surface), gutter, taken);
        }
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x)
                sums_[at(x + 1, y + 1)] =
                    sums_[at(x, y + 1)] + sums_[at(x + 1, y)] - sums_[at(x, y)] +
                    taken[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
    }

    /// Corner of a free rectangle on one page, or (-1, -1).
    glm::ivec2 find(const glm::ivec2& size) const
    {
        const auto on_one = [&](int first, int count) {
            return first / page_side_ == (first + std::max(count, 1) - 1) / page_side_;
        };
        for (int y = 0; y + size.y <= side_; ++y)
            for (int x = 0; x + size.x <= side_; ++x)
                if (on_one(x, size.x) && on_one(y, size.y) &&
                    sums_[at(x + size.x, y + size.y)] + sums_[at(x, y)] ==
                        sums_[at(x, y + size.y)] + sums_[at(x + size.x, y)])
                    return {x, y};
        return glm::ivec2(-1);
    }

private:
    std::size_t at(int x, int y) const
    {
        return std::size_t(y) * std::size_t(side_ + 1) + std::size_t(x);
    }

    void take_all(const Surface& surface, int gutter, std::vector<char>& taken) const
    {
        for (std::size_t k = 0; k + 2 < surface.indices.size(); k += 3)
            take(surface, k, gutter, taken);
    }

    /// Marks the triangle's bounding rectangle: charts fill theirs well enough.
    void take(const Surface& surface, std::size_t k, int gutter, std::vector<char>& taken) const
    {
        glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
        for (std::size_t corner = k; corner < k + 3; ++corner) {
            low = glm::min(low, surface.texcoord[surface.indices[corner]]);
            high = glm::max(high, surface.texcoord[surface.indices[corner]]);
        }
        const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(low)) - gutter, glm::ivec2(0));
        const glm::ivec2 last = glm::min(glm::ivec2(glm::ceil(high)) + gutter, glm::ivec2(side_));
        for (int y = first.y; y < last.y; ++y)
            std::fill_n(taken.begin() + std::ptrdiff_t(y) * side_ + first.x,
                        std::max(last.x - first.x, 0), char(1));
    }

    int side_, page_side_;
    std::vector<std::uint32_t> sums_;  // [side + 1][side + 1] taken texels above and left
};

/// Bounds of the covered texels.
struct Extent {
    glm::ivec2 low{0}, high{0};
};

Extent extent_of(const Atlas& atlas)
{
    glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
    for (const Surface& surface : atlas.surfaces)
        for (const glm::vec2& place : surface.texcoord) {
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    return {glm::ivec2(glm::floor(low)), glm::ivec2(glm::ceil(high))};
}

/// Atlas of the new objects alone, at the density of the rest.
Atlas atlas_of_new(const Scene& after, const Matches& matches, float texels_per_metre, int gutter)
{
    Scene fresh = after;
    fresh.meshes.emplace_back();
    for (std::size_t i = 0; i < fresh.instances.size(); ++i)
        if (matches.before[i] != kNoInstance)
            fresh.instances[i].mesh = int(fresh.meshes.size()) - 1;
    return make_atlas(fresh, {.texels_per_metre = texels_per_metre, .gutter = gutter});
}

/// Places the surfaces of `fresh` in free space of `atlas`, or enlarges it.
void add_beside(Atlas& atlas, Atlas fresh, int gutter)
{
    const Extent extent = extent_of(fresh);
    const glm::ivec2 size = extent.high - extent.low;
    glm::ivec2 corner = Room(atlas, gutter).find(size);
    if (corner.x < 0 && atlas.pages.count > 1)
        throw Error(ErrorKind::input, "",
                    "new objects do not fit into the pages of the lightmap; bake the scene again");
    if (corner.x < 0) {
        corner = {atlas.width + gutter, 0};
        atlas.width = atlas.height = std::max(corner.x + size.x, std::max(atlas.height, size.y));
        atlas.pages.side = atlas.width;
        atlas.notes.emplace_back("new objects did not fit: the lightmap has been enlarged");
    }
    atlas.pages.count = std::max(atlas.pages.count, atlas.pages.at(glm::vec2(corner)) + 1);
    for (Surface& surface : fresh.surfaces) {
        for (glm::vec2& place : surface.texcoord)
            place += glm::vec2(corner - extent.low);
        for (std::uint32_t& chart : surface.chart)
            chart += atlas.chart_count;
        atlas.surfaces.push_back(std::move(surface));
    }
    atlas.chart_count += fresh.chart_count;
    if (!atlas.back_shift.empty())
        atlas.back_shift.resize(atlas.chart_count, glm::ivec2(0));
}

}  // namespace

Atlas written_atlas(const Scene& scene, const Pages& pages, float texels_per_metre,
                    const StoredCharts& charts)
{
    Atlas atlas;
    atlas.pages = pages;
    atlas.width = atlas.height = pages.map_side();
    if (charts.of_texel.size() != std::size_t(atlas.width) * std::size_t(atlas.height))
        throw Error(ErrorKind::input, scene.path,
                    "does not match the files beside it: their maps have other sizes");
    atlas.texels_per_metre = texels_per_metre;
    for (const std::uint32_t chart : charts.of_texel)
        if (chart != kNoChart)
            atlas.chart_count = std::max(atlas.chart_count, chart + 1);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            const Primitive& primitive = mesh.primitives[p];
            if (primitive.texcoords[1].empty())
                throw Error(ErrorKind::input, scene.path,
                            "has no TEXCOORD_1: it was changed after the bake");
            Surface surface{.instance = i, .primitive = p, .indices = primitive.indices};
            for (std::uint32_t v = 0; v < primitive.positions.size(); ++v) {
                const int page = page_of(scene, primitive, v);
                if (page >= pages.count)
                    throw Error(ErrorKind::input, scene.path,
                                "names a page of the lightmap that it does not have");
                surface.source_vertex.push_back(v);
                const glm::vec2 texel =
                    glm::vec2(pages.corner(page)) + primitive.texcoords[1][v] * float(pages.side);
                surface.texcoord.emplace_back(snapped(texel.x), snapped(texel.y));
            }
            surface.chart = charts_of(surface, atlas, charts);
            // Triangles that cover no texel centre with a known chart get their own.
            for (std::uint32_t& chart : surface.chart)
                if (chart == kNoChart)
                    chart = atlas.chart_count;
            atlas.surfaces.push_back(std::move(surface));
        }
    }
    ++atlas.chart_count;
    atlas.shows_front = charts.shows_front;
    atlas.back_shift = charts.back_shift;
    if (!atlas.back_shift.empty())
        atlas.back_shift.resize(atlas.chart_count, glm::ivec2(0));
    return atlas;
}

Atlas kept_atlas(const Scene& before, const Atlas& atlas, const Scene& after,
                 const Matches& matches, int gutter)
{
    const std::vector<std::size_t> first = first_surfaces(atlas, before.instances.size());
    Atlas kept = atlas;
    kept.surfaces.clear();
    bool any_new = false;
    for (std::uint32_t i = 0; i < after.instances.size(); ++i) {
        const Mesh& mesh = after.meshes[after.instances[i].mesh];
        if (matches.before[i] == kNoInstance) {
            any_new |= !mesh.primitives.empty();
            continue;
        }
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
            kept.surfaces.push_back(
                moved_over(atlas.surfaces[first[matches.before[i]] + p], mesh.primitives[p], i));
    }
    if (any_new) {
        add_beside(kept, atlas_of_new(after, matches, atlas.texels_per_metre, gutter), gutter);
        std::sort(
            kept.surfaces.begin(), kept.surfaces.end(), [](const Surface& a, const Surface& b) {
                return std::pair(a.instance, a.primitive) < std::pair(b.instance, b.primitive);
            });
    }
    return kept;
}

}  // namespace lumel
