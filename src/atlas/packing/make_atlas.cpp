// The atlas: chooses a layout for every surface, packs, numbers the charts.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "atlas/charts/authored.h"
#include "atlas/charts/layout.h"
#include "atlas/packing/atlas.h"
#include "atlas/packing/density.h"
#include "atlas/packing/morton.h"
#include "atlas/packing/pack.h"
#include "base/core/error.h"
#include "base/core/parallel.h"

namespace lumel {

namespace {

constexpr int kLargestSide = 16384;  // image side of common GPUs
constexpr int kLargestGutter = 64;   // sufficient up to the sixth mip level
/// Approximate progress at the end of each stage.
constexpr double kChecked = 0.1, kPlanned = 0.75, kSidesKnown = 0.85, kPacked = 0.9;
constexpr std::size_t kMaxMeshNotes = 8;  // further ones are summarised
// Charts that end this close to a texel's border end on it, so that rounding adds no texel.
constexpr double kSnapDistance = 1e-3;
// Share of a map that charts of an ordinary scene cover.
constexpr double kLikelyFill = 0.5;
constexpr double kMinLeft = 0.01;  // minimum share of that beside charts of fixed density
// Relative tolerance for transforms that share charts.
constexpr double kSameScale = 1e-5;

/// A surface to be packed.
struct Plan {
    std::uint32_t instance = 0;
    std::uint32_t primitive = 0;
    bool authored = false;
    std::shared_ptr<const Layout> layout;
    std::uint32_t first_item = 0;  ///< rectangle of its first chart; the only one if authored
    glm::dvec2 origin{0.0};        ///< the rectangle's, in layout coordinates
};

/// All surfaces and rectangles to be packed.
struct Plans {
    std::vector<Plan> surfaces;
    std::vector<Rectangle> items;
    std::vector<glm::dvec2> extent;  ///< [items] size in layout coordinates
};

using Densities = std::vector<std::vector<Density>>;  // [instances][primitives]

void check(const Scene& scene, const AtlasOptions& options)
{
    if (options.max_size < 1 || options.size < 0 || options.gutter < 0 ||
        !(options.texels_per_metre >= 0.0f) || !std::isfinite(options.texels_per_metre))
        throw Error(ErrorKind::input, "", "sizes of the map must be positive");
    if (std::max(options.size, options.max_size) > kLargestSide || options.gutter > kLargestGutter)
        throw Error(ErrorKind::input, "",
                    fmt::format("a map can have at most {} texels a side and gutters of {}",
                                kLargestSide, kLargestGutter));
    if (const Pages most{options.pages, std::max(options.size, options.max_size)};
        options.pages < 1 || options.pages > kMaxPages || most.map_side() > kLargestSide)
        throw Error(ErrorKind::input, "",
                    fmt::format("{} pages of {} texels a side are too many: all of them together "
                                "can have {} a side",
                                options.pages, most.side, kLargestSide));
    for (const DensityRule& rule : options.densities)
        if (!(rule.texels_per_metre > 0.0f) || !std::isfinite(rule.texels_per_metre))
            throw Error(ErrorKind::input, rule.pattern, "its density must be positive");
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
            if (!primitive.indices.empty())
                return;
    throw Error(ErrorKind::input, scene.path, "there is no triangle to light");
}

double world_area(const Primitive& primitive, const glm::mat4& transform)
{
    double area = 0.0;
    const std::vector<glm::dvec3> world = world_positions(primitive, transform);
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::dvec3& a = world[primitive.indices[i]];
        area += 0.5 * glm::length(glm::cross(world[primitive.indices[i + 1]] - a,
                                             world[primitive.indices[i + 2]] - a));
    }
    return area;
}

double world_area(const Mesh& mesh, const glm::mat4& transform)
{
    double area = 0.0;
    for (const Primitive& primitive : mesh.primitives)
        area += world_area(primitive, transform);
    return area;
}

/// Estimate of the packed density [texels/m].
double likely_density(const Scene& scene, const Densities& densities, const AtlasOptions& options)
{
    double area = 0.0, fixed = 0.0;  // [m²], and texels of fixed densities
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const std::vector<Primitive>& primitives = scene.meshes[instance.mesh].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Density& density = densities[i][p];
            const double own = world_area(primitives[p], instance.transform);
            (density.fixed > 0.0 ? fixed : area) += own * density.in(1.0) * density.in(1.0);
        }
    }
    const double density = options.texels_per_metre > 0.0f ? options.texels_per_metre : 1e30;
    const bool asked = options.size > 0 || options.texels_per_metre > 0.0f;
    const double pages = asked ? options.pages : 1;
    const int side = options.size > 0 ? options.size
                     : density < 1e30 ? options.max_size
                                      : std::min(kDefaultSide, options.max_size);
    const double left = std::max(kLikelyFill - fixed / (pages * side * side), kMinLeft);
    return std::min(density, side * std::sqrt(pages * left / std::max(area, 1e-30)));
}

/// Rounded metric of a transform: instances that differ only in position and rotation share charts.
std::vector<long long> scale_key(const glm::mat4& transform)
{
    const glm::dmat3 linear(transform);
    const glm::dmat3 metric = glm::transpose(linear) * linear;
    const double trace = std::max(metric[0][0] + metric[1][1] + metric[2][2], 1e-300);
    std::vector<long long> key{std::llround(std::log(trace) / kSameScale),
                               glm::determinant(linear) < 0.0};
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            key.push_back(std::llround(metric[i][j] / trace / kSameScale));
    return key;
}

/// Common density of an instance's primitives that share one layout.
Density densest(const std::vector<Density>& densities)
{
    Density densest{0.0, 0.0};
    for (const Density& density : densities) {
        densest.fixed = std::max(densest.fixed, density.fixed);
        densest.relative = std::max(densest.relative, density.relative);
    }
    return densest;
}

/// Adds one rectangle for the mesh's own layout in the instance, at the density of its surface.
void plan_authored(const Scene& scene, std::uint32_t instance_index, const AuthoredReport& report,
                   const std::vector<Density>& densities, Plans& plans)
{
    const Instance& instance = scene.instances[instance_index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::size_t first = plans.surfaces.size();
    glm::dvec2 low(1.0), high(0.0);
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        auto layout = std::make_shared<const Layout>(authored_layout(mesh.primitives[p]));
        for (std::uint32_t index : layout->indices) {
            low = glm::min(low, layout->place[index]);
            high = glm::max(high, layout->place[index]);
        }
        plans.surfaces.push_back({instance_index, p, true, layout, 0, {}});
    }
    for (std::size_t s = first; s < plans.surfaces.size(); ++s) {
        plans.surfaces[s].first_item = std::uint32_t(plans.items.size());
        plans.surfaces[s].origin = low;
    }
    const double metres = std::sqrt(world_area(mesh, instance.transform) / report.area);
    plans.extent.push_back(high - low);
    plans.items.push_back({metres * (high - low), densest(densities), std::uint32_t(first),
                           std::uint32_t(plans.items.size())});
}

/// Makes charts for every planned surface without a layout, in parallel. `common`: estimate of the
/// packed density [texels/m].
void plan_charts(const Scene& scene, const Densities& densities, double common, int gutter,
                 Plans& plans)
{
    const auto density_of = [&](const Plan& plan) {
        return densities[plan.instance][plan.primitive].in(common);
    };
    using Key = std::tuple<int, std::uint32_t, double, std::vector<long long>>;
    std::map<Key, std::vector<std::size_t>> users;
    for (std::size_t s = 0; s < plans.surfaces.size(); ++s) {
        const Plan& plan = plans.surfaces[s];
        const Instance& instance = scene.instances[plan.instance];
        if (!plan.layout)
            users[{instance.mesh, plan.primitive, density_of(plan), scale_key(instance.transform)}]
                .push_back(s);
    }
    std::vector<const std::vector<std::size_t>*> groups;
    for (const auto& [key, surfaces] : users)
        groups.push_back(&surfaces);
    parallel_for(groups.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t g = first; g < last; ++g) {
            const Plan& leader = plans.surfaces[groups[g]->front()];
            const Instance& instance = scene.instances[leader.instance];
            const Primitive& primitive = scene.meshes[instance.mesh].primitives[leader.primitive];
            const auto layout = std::make_shared<const Layout>(
                make_charts(primitive, world_positions(primitive, instance.transform),
                            glm::determinant(glm::dmat3(instance.transform)) < 0.0,
                            {density_of(leader), gutter}));
            for (std::size_t s : *groups[g])
                plans.surfaces[s].layout = layout;
        }
    });
}

Plans plan(const Scene& scene, const std::vector<AuthoredReport>& reports,
           const AtlasOptions& options)
{
    const Densities densities = densities_of(scene, options);
    Plans plans;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const int mesh = scene.instances[i].mesh;
        if (reports[mesh].valid()) {
            plan_authored(scene, i, reports[mesh], densities[i], plans);
            continue;
        }
        for (std::uint32_t p = 0; p < scene.meshes[mesh].primitives.size(); ++p)
            plans.surfaces.push_back({i, p, false, nullptr, 0, {}});
    }
    plan_charts(scene, densities, likely_density(scene, densities, options), options.gutter, plans);
    for (std::uint32_t group = 0; group < plans.surfaces.size(); ++group) {
        Plan& surface = plans.surfaces[group];
        if (surface.authored)
            continue;
        surface.first_item = std::uint32_t(plans.items.size());
        for (const glm::dvec2& size : surface.layout->chart_size) {
            plans.items.push_back({size, densities[surface.instance][surface.primitive], group,
                                   std::uint32_t(plans.items.size())});
            plans.extent.push_back(size);
        }
    }
    return plans;
}

/// Uses the file's single layout of the whole scene for the whole map.
Packing pack_scene_wide(const Scene& scene, const std::vector<AuthoredReport>& reports,
                        const AtlasOptions& options, Plans& plans, std::vector<std::string>& notes)
{
    double metres = 0.0, area = 0.0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        metres += world_area(mesh, instance.transform);
        area += reports[instance.mesh].area;
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
            plans.surfaces.push_back(
                {i,
                 p,
                 true,
                 std::make_shared<const Layout>(authored_layout(mesh.primitives[p])),
                 0,
                 {}});
    }
    plans.extent = {glm::dvec2(1.0)};
    plans.items = {{glm::dvec2(std::sqrt(metres / area)), {}}};
    AtlasOptions whole = options;
    whole.gutter = 0;
    whole.pages = 1;
    Packing packing = pack(plans.items, whole, notes);
    packing.rectangles[0] = {glm::ivec2(0), glm::ivec2(packing.pages.side)};
    return packing;
}

double snap(double texel, double side)
{
    if (std::abs(texel) < kSnapDistance)
        return 0.0;
    return std::abs(texel - side) < kSnapDistance ? side : texel;
}

Surface place(const Plan& plan, const Plans& plans, const Packing& packing)
{
    const Layout& layout = *plan.layout;
    Surface surface{plan.instance,  plan.primitive, layout.source_vertex, {},
                    layout.indices, layout.chart,   plan.authored};
    if (plan.first_item < plans.items.size())
        surface.texels_per_metre = float(plans.items[plan.first_item].density.in(packing.density));
    surface.texcoord.reserve(layout.place.size());
    for (std::size_t v = 0; v < layout.place.size(); ++v) {
        const std::uint32_t item = plan.first_item + (plan.authored ? 0 : layout.vertex_chart[v]);
        const PackedRectangle& rectangle = packing.rectangles[item];
        const glm::dvec2 scale =
            glm::dvec2(rectangle.size) / glm::max(plans.extent[item], glm::dvec2(1e-30));
        const glm::dvec2 texel = (layout.place[v] - plan.origin) * scale;
        surface.texcoord.emplace_back(
            glm::dvec2(rectangle.corner) +
            glm::dvec2(snap(texel.x, rectangle.size.x), snap(texel.y, rectangle.size.y)));
    }
    return surface;
}

/// Numbers the charts along a Morton curve in world space, so that adjacent numbers are close.
void number_charts(const Scene& scene, Atlas& atlas)
{
    std::vector<glm::dvec4> centre;  // per chart: area × position, area
    for (Surface& surface : atlas.surfaces) {
        const Instance& instance = scene.instances[surface.instance];
        const Primitive& primitive = scene.meshes[instance.mesh].primitives[surface.primitive];
        const std::vector<glm::dvec3> world = world_positions(primitive, instance.transform);
        const std::uint32_t first = std::uint32_t(centre.size());
        for (std::size_t t = 0; t < surface.chart.size(); ++t) {
            surface.chart[t] += first;
            centre.resize(std::max<std::size_t>(centre.size(), surface.chart[t] + 1));
            const glm::dvec3& a = world[primitive.indices[3 * t]];
            const glm::dvec3& b = world[primitive.indices[3 * t + 1]];
            const glm::dvec3& c = world[primitive.indices[3 * t + 2]];
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            centre[surface.chart[t]] += area * glm::dvec4((a + b + c) / 3.0, 1.0);
        }
    }
    glm::dvec3 low(1e300), high(-1e300);
    for (glm::dvec4& point : centre) {
        point = point / std::max(point.w, 1e-300);
        low = glm::min(low, glm::dvec3(point));
        high = glm::max(high, glm::dvec3(point));
    }
    const glm::dvec3 extent = high - low;
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-300});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t chart = 0; chart < centre.size(); ++chart)
        order.push_back({morton_code((glm::dvec3(centre[chart]) - low) / longest), chart});
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> number(centre.size());
    for (std::uint32_t rank = 0; rank < order.size(); ++rank)
        number[order[rank].second] = rank;
    for (Surface& surface : atlas.surfaces)
        for (std::uint32_t& chart : surface.chart)
            chart = number[chart];
    atlas.chart_count = std::uint32_t(centre.size());
}

std::uint32_t item_of(const Plan& plan, std::size_t triangle)
{
    return plan.first_item + (plan.authored ? 0u : plan.layout->chart[triangle]);
}

/// Units that show one or both sides: our charts, and whole primitives of the file's layouts.
class Sheets {
public:
    explicit Sheets(const Plans& plans)
    {
        for (const Plan& plan : plans.surfaces) {
            first_.push_back(triangles_.size());
            triangles_.resize(triangles_.size() +
                              (plan.authored ? 1 : plan.layout->chart_size.size()));
            for (std::uint32_t t = 0; t < plan.layout->chart.size(); ++t)
                triangles_[number(plan, first_.size() - 1, t)].push_back(
                    {plan.instance, plan.primitive, t});
        }
    }

    std::span<const std::vector<TriangleOf>> triangles() const { return triangles_; }

    /// Index of the unit of a triangle of plan s.
    std::size_t number(const Plan& plan, std::size_t s, std::size_t triangle) const
    {
        return first_[s] + (plan.authored ? 0u : plan.layout->chart[triangle]);
    }

private:
    std::vector<std::vector<TriangleOf>> triangles_;
    std::vector<std::size_t> first_;  ///< [plans]
};

/// The triangles of each primitive of each instance.
std::vector<std::vector<TriangleOf>> triangles_of_surfaces(const Scene& scene)
{
    std::vector<std::vector<TriangleOf>> triangles;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            triangles.emplace_back();
            for (std::uint32_t t = 0; t < mesh.primitives[p].indices.size() / 3; ++t)
                triangles.back().push_back({i, p, t});
        }
    }
    return triangles;
}

/// True if no side needs space of its own, which the file's layout of the whole scene does not
/// have.
bool has_no_backs(const std::vector<ChartSides>& sides, std::vector<std::string>& notes)
{
    if (std::ranges::none_of(sides, &ChartSides::shows_both))
        return true;
    notes.emplace_back("TEXCOORD_1 has no space for the backs of double-sided surfaces, so each "
                       "mesh is packed again; --sides brighter keeps the layout");
    return false;
}

/// Packs the rectangles, and a second one of equal size for the backs of each item with a two-sided
/// unit. back: [items] the rectangle of its backs, or its own.
Packing pack_sides(const Plans& plans, const Sheets& sheets, const std::vector<ChartSides>& sides,
                   const AtlasOptions& options, std::vector<std::uint32_t>& back,
                   std::vector<std::string>& notes)
{
    back.resize(plans.items.size());
    std::iota(back.begin(), back.end(), 0u);
    std::vector<Rectangle> items = plans.items;
    for (std::size_t s = 0; s < plans.surfaces.size() && !sides.empty(); ++s)
        for (std::size_t t = 0; t < plans.surfaces[s].layout->chart.size(); ++t) {
            const std::uint32_t item = item_of(plans.surfaces[s], t);
            if (!sides[sheets.number(plans.surfaces[s], s, t)].shows_both || back[item] != item)
                continue;
            back[item] = std::uint32_t(items.size());
            items.push_back(plans.items[item]);
        }
    return pack(items, options, notes);
}

/// Offsets from fronts of charts to their backs.
std::vector<glm::ivec2> back_shifts(const Plans& plans, const Sheets& sheets,
                                    const std::vector<ChartSides>& sides, const Packing& packing,
                                    const std::vector<std::uint32_t>& back, const Atlas& atlas)
{
    std::vector<glm::ivec2> shifts(atlas.chart_count, glm::ivec2(0));
    for (std::size_t s = 0; s < plans.surfaces.size(); ++s)
        for (std::size_t t = 0; t < atlas.surfaces[s].chart.size(); ++t) {
            if (!sides[sheets.number(plans.surfaces[s], s, t)].shows_both)
                continue;
            const std::uint32_t item = item_of(plans.surfaces[s], t);
            shifts[atlas.surfaces[s].chart[t]] =
                packing.rectangles[back[item]].corner - packing.rectangles[item].corner;
        }
    return shifts;
}

/// [charts] Sides inside solids. unit: index in `sides` of a triangle of a surface.
template <class Unit>
std::vector<std::array<bool, 2>> inner_sides(const Atlas& atlas,
                                             const std::vector<ChartSides>& sides, const Unit& unit)
{
    std::vector<std::array<bool, 2>> inner(atlas.chart_count);
    for (std::size_t s = 0; s < atlas.surfaces.size(); ++s)
        for (std::size_t t = 0; t < atlas.surfaces[s].chart.size(); ++t)
            inner[atlas.surfaces[s].chart[t]] = sides[unit(s, t)].inner;
    return inner;
}

/// Checks the layouts of the file, and warns of unusable ones.
std::vector<AuthoredReport> check_all(const Scene& scene, std::vector<std::string>& notes)
{
    std::vector<AuthoredReport> reports;
    std::size_t refused = 0;
    for (const Mesh& mesh : scene.meshes) {
        reports.push_back(check_authored(mesh));
        if (!reports.back().present || reports.back().valid())
            continue;
        if (++refused <= kMaxMeshNotes)
            notes.push_back(fmt::format("mesh '{}': TEXCOORD_1 {}; charts are made instead",
                                        mesh.name, reports.back().complaint()));
    }
    if (refused > kMaxMeshNotes)
        notes.push_back(
            fmt::format("TEXCOORD_1 of {} more meshes is unusable too", refused - kMaxMeshNotes));
    return reports;
}

}  // namespace

Atlas make_atlas(const Scene& scene, const AtlasOptions& requested,
                 const ProgressCallback& progress, const FindSides& find_sides)
{
    check(scene, requested);
    Atlas atlas;
    AtlasOptions options = requested;
    if (options.size > options.max_size) {
        options.size = options.max_size;
        atlas.notes.push_back(fmt::format("the map is limited to {} × {} texels, not {} × {}",
                                          options.size, options.size, requested.size,
                                          requested.size));
    }

    const std::vector<AuthoredReport> reports = check_all(scene, atlas.notes);
    notify(progress, kChecked);
    // Builds the layouts and packs them.
    Plans plans;
    Packing packing;
    std::optional<Sheets> sheets;
    std::vector<ChartSides> sides;
    std::vector<std::uint32_t> back;
    const bool scene_wide = is_scene_wide(scene, reports);
    if (scene_wide && find_sides)
        sides = find_sides(scene, triangles_of_surfaces(scene));
    if (scene_wide && has_no_backs(sides, atlas.notes)) {
        packing = pack_scene_wide(scene, reports, options, plans, atlas.notes);
    } else {
        plans = plan(scene, reports, options);
        notify(progress, kPlanned);
        sheets.emplace(plans);
        if (find_sides)
            sides = find_sides(scene, sheets->triangles());
        notify(progress, kSidesKnown);
        packing = pack_sides(plans, *sheets, sides, options, back, atlas.notes);
    }
    notify(progress, kPacked);
    atlas.pages = packing.pages;
    atlas.width = atlas.height = packing.pages.map_side();
    atlas.texels_per_metre = float(packing.density);
    for (const Plan& surface : plans.surfaces)
        atlas.surfaces.push_back(place(surface, plans, packing));
    number_charts(scene, atlas);
    if (std::size_t(packing.rectangles.size()) > plans.items.size())
        atlas.back_shift = back_shifts(plans, *sheets, sides, packing, back, atlas);
    if (!sides.empty())
        atlas.inner = inner_sides(atlas, sides, [&](std::size_t s, std::size_t t) {
            return sheets ? sheets->number(plans.surfaces[s], s, t) : s;
        });
    atlas.shows_front = options.sides == Sides::front;
    for (const std::string& pattern : unmatched(scene, options.densities))
        atlas.notes.push_back(fmt::format(
            "no object, mesh or material is named '{}': its density is ignored", pattern));
    return atlas;
}

}  // namespace lumel
