#include "solve/transport/voxel_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "atlas/lumels/sides.h"
#include "base/core/error.h"
#include "base/core/frame.h"

namespace lumel {
namespace {

/// Key of a patch: cell, cube side that its lumels face, chart.
using Key = std::array<std::int32_t, 5>;
inline constexpr std::int32_t kAnyChart = -1;

/// Offset of the grid's corner from the scene's [voxels]: surfaces rarely lie on its planes.
constexpr glm::vec3 kGridShift{0.381966f, 0.414214f, 0.267949f};
/// Bisection steps in the search for the finest grid; the voxel side is then known to about 1 %.
constexpr int kHalvings = 12;
/// Voxels along the scene's diagonal in the finest grid; the coarsest has one.
constexpr float kMaxVoxels = 4096.0f;

struct Place {
    glm::vec3 position;  ///< world space
    std::int32_t facing;
    std::int32_t chart;  ///< includes its side
    float area;
    glm::vec3 normal;
};

std::vector<Place> places_of(const World& world, const Lumels& lumels)
{
    std::vector<Place> places;
    places.reserve(lumels.lumels.size());
    for (const Lumel& lumel : lumels.lumels) {
        const auto [position, normal] = placed(world, lumel);
        const bool back = (lumel.flags & kLumelBack) != 0;
        places.push_back({position, cube_side(normal),
                          std::int32_t(2 * lumel.chart + (back ? 1 : 0)),
                          (lumel.flags & kLumelBuried) ? 0.0f : lumel.area, normal});
    }
    return places;
}

struct Grid {
    glm::vec3 low{0.0f}, high{0.0f};
    std::vector<float> chart_area;  ///< [2 × charts]
};

Grid grid_of(const std::vector<Place>& places)
{
    Grid grid{places.front().position, places.front().position, {}};
    for (const Place& place : places) {
        grid.low = glm::min(grid.low, place.position);
        grid.high = glm::max(grid.high, place.position);
        grid.chart_area.resize(std::max(grid.chart_area.size(), std::size_t(place.chart) + 1));
        grid.chart_area[std::size_t(place.chart)] += place.area;
    }
    return grid;
}

Key key_of(const Place& place, const Grid& grid, float side)
{
    const glm::ivec3 cell((place.position - grid.low) / side + kGridShift);
    const bool large = grid.chart_area[std::size_t(place.chart)] >= side * side;
    return {cell.x, cell.y, cell.z, place.facing, large ? place.chart : kAnyChart};
}

/// Lumels of one chart that are connected without crossing a wall.
class Components {
public:
    explicit Components(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t root(std::uint32_t i)
    {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t i, std::uint32_t j)
    {
        const std::uint32_t a = root(i), b = root(j);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

struct GridInputs {
    std::vector<Place> places;  ///< [N]
    Grid grid;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joins;  ///< lumels that no wall separates
    bool walls = false;                                          ///< true if walls are known
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> joins_of(const Lumels& lumels,
                                                              const Surroundings& around)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joins;
    const std::vector<std::uint32_t> at = lumels_by_side(lumels);
    for (std::uint32_t i = 0; i < around.joined_right.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const std::size_t here = place_by_side(lumel);
        if (around.joined_right[i])
            joins.emplace_back(i, at[here + 2]);
        if (around.joined_below[i])
            joins.emplace_back(i, at[here + 2 * std::size_t(lumels.width)]);
    }
    return joins;
}

/// The patch of each lumel, numbered in order of first use.
std::vector<std::uint32_t> numbers_of(const GridInputs& layout, float side, std::size_t& count)
{
    const std::size_t lumels = layout.places.size();
    std::vector<Key> keys;
    keys.reserve(lumels);
    for (const Place& place : layout.places)
        keys.push_back(key_of(place, layout.grid, side));
    Components components(lumels);
    for (const auto& [i, j] : layout.joins)
        if (keys[i] == keys[j])
            components.join(i, j);
    std::map<std::pair<Key, std::uint32_t>, std::uint32_t> numbers;
    std::vector<std::uint32_t> result(lumels, kPatchless);
    for (std::uint32_t i = 0; i < lumels; ++i) {
        if (layout.places[i].area <= 0.0f)
            continue;
        const bool whole = !layout.walls || keys[i].back() == kAnyChart;
        const auto number = std::uint32_t(numbers.size());
        result[i] =
            numbers.try_emplace({keys[i], whole ? 0 : components.root(i)}, number).first->second;
    }
    count = numbers.size();
    return result;
}

/// The smallest side [m] found that makes at most `most` patches.
float voxel_side(const GridInputs& layout, std::uint32_t most)
{
    const auto count = [&](float side) {
        std::size_t patches = 0;
        numbers_of(layout, side, patches);
        return patches;
    };
    float coarse = glm::distance(layout.grid.low, layout.grid.high);
    float fine = coarse / kMaxVoxels;
    if (count(fine) <= most)
        return fine;
    for (int i = 0; i < kHalvings; ++i) {
        const float side = std::sqrt(coarse * fine);
        (count(side) <= most ? coarse : fine) = side;
    }
    return coarse;
}

void add_to(VoxelPatch& patch, const Place& place, const Lumel& lumel)
{
    patch.area += place.area;
    patch.centre += place.area * place.position;
    patch.normal += place.area * place.normal;
    patch.color += place.area * lumel.albedo;
}

void finish(VoxelPatch& patch)
{
    patch.centre /= patch.area;
    patch.color /= patch.area;
    patch.normal = glm::normalize(patch.normal);
}

}  // namespace

PlacedLumel placed(const World& world, const Lumel& lumel)
{
    const glm::mat4& place = world.placements()[lumel.instance].now;
    const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(place)));
    return {glm::vec3(place * glm::vec4(lumel.position, 1.0f)),
            glm::normalize(normals * lumel.normal)};
}

VoxelPatches make_voxel_patches(const World& world, const Lumels& lumels,
                                const Surroundings& around, std::uint32_t most)
{
    GridInputs layout{
        places_of(world, lumels), {}, joins_of(lumels, around), !around.joined_right.empty()};
    layout.grid = grid_of(layout.places);
    VoxelPatches result;
    result.side = voxel_side(layout, most);
    std::size_t count = 0;
    result.patch_of = numbers_of(layout, result.side, count);
    if (count < 2 || count > most)
        throw Error(
            ErrorKind::input, "--patches " + std::to_string(most),
            "the scene cannot be divided into at least 2 and at most this number of patches");
    result.patches.resize(count);
    for (std::size_t i = 0; i < layout.places.size(); ++i)
        if (result.patch_of[i] != kPatchless)
            add_to(result.patches[result.patch_of[i]], layout.places[i], lumels.lumels[i]);
    for (VoxelPatch& patch : result.patches)
        finish(patch);
    return result;
}

std::vector<glm::vec3> VoxelPatches::means(const Lumels& lumels,
                                           std::span<const glm::vec3> values) const
{
    std::vector<glm::vec3> sums(size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (patch_of[i] != kPatchless)
            sums[patch_of[i]] += lumels.lumels[i].area * values[i];
    for (std::size_t patch = 0; patch < size(); ++patch)
        sums[patch] /= patches[patch].area;
    return sums;
}

std::vector<glm::vec3> VoxelPatches::reflected_means(const Lumels& lumels,
                                                     std::span<const glm::vec3> irradiance) const
{
    std::vector<float> area;
    std::vector<glm::vec3> albedo;
    for (const Lumel& lumel : lumels.lumels) {
        area.push_back(lumel.area);
        albedo.push_back(lumel.albedo);
    }
    return reflected_means(area, albedo, irradiance);
}

std::vector<glm::vec3> VoxelPatches::reflected_means(std::span<const float> area,
                                                     std::span<const glm::vec3> albedo,
                                                     std::span<const glm::vec3> irradiance) const
{
    std::vector<glm::vec3> sums(size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        if (patch_of[i] != kPatchless)
            sums[patch_of[i]] += area[i] * albedo[i] * irradiance[i];
    for (std::size_t patch = 0; patch < size(); ++patch)
        for (int c = 0; c < 3; ++c)
            if (const float reflected = patches[patch].area * patches[patch].color[c];
                reflected > 0.0f)
                sums[patch][c] /= reflected;
    return sums;
}

std::vector<glm::vec3> sent_by(const VoxelPatches& patches, std::span<const glm::vec3> direct,
                               std::span<const glm::vec3> reflected)
{
    std::vector<glm::vec3> sent;
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
        sent.push_back(patches.patches[patch].color * (direct[patch] + reflected[patch]));
    return sent;
}

Elements elements_of(const VoxelPatches& patches)
{
    Elements elements;
    for (const VoxelPatch& patch : patches.patches) {
        elements.color.push_back(patch.color);
        elements.area.push_back(patch.area);
        elements.place.push_back(patch.centre);
        elements.normal.push_back(patch.normal);
    }
    return elements;
}

}  // namespace lumel
