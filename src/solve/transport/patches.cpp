#include "solve/transport/patches.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Minimum cosine between normals of a patch and their mean (15°).
constexpr float kMinAgreement = 0.966f;
/// Maximum distance of a flat patch's lumels from its plane, relative to its size.
constexpr float kFlatness = 0.02f;

struct Range {
    std::uint32_t first, last;
};

/// Block of 2^exponent texels a side that contains the lumel.
glm::uvec2 block_of(const Lumels& lumels, std::uint32_t i, std::uint32_t exponent)
{
    const auto width = std::uint32_t(lumels.width);
    const std::uint32_t texel = lumels.lumels[i].texel;
    return {(texel % width) >> exponent, (texel / width) >> exponent};
}

/// The lumels from `first` on in the same block: neighbours along the Morton curve.
Range next_block(const Lumels& lumels, std::uint32_t first, std::uint32_t end,
                 std::uint32_t exponent)
{
    const glm::uvec2 block = block_of(lumels, first, exponent);
    std::uint32_t last = first + 1;
    while (last < end && block_of(lumels, last, exponent) == block)
        ++last;
    return {first, last};
}

bool is_buried(const Lumel& lumel)
{
    return (lumel.flags & kLumelBuried) != 0;
}

struct Shape {
    glm::vec3 centre{0.0f};  ///< instance frame
    float size = 0.0f;       ///< [m]
    bool flat = true, bent = false;
};

Shape shape_of(const Lumels& lumels, const Range& range)
{
    Shape shape;
    glm::vec3 normal(0.0f);
    float area = 0.0f;
    for (std::uint32_t i = range.first; i < range.last; ++i) {
        const Lumel& lumel = lumels.lumels[i];
        shape.centre += lumel.area * lumel.position;
        normal += lumel.area * lumel.normal;
        area += lumel.area;
    }
    const Lumel& first = lumels.lumels[range.first];
    shape.centre = area > 0.0f ? shape.centre / area : first.position;
    normal = glm::length(normal) > 0.0f ? glm::normalize(normal) : first.normal;
    for (std::uint32_t i = range.first; i < range.last; ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const glm::vec3 offset = lumel.position - shape.centre;
        shape.size = std::max(shape.size, 2.0f * glm::length(offset) + lumel.size);
        shape.bent |= glm::dot(lumel.normal, normal) < kMinAgreement;
        shape.flat &= std::abs(glm::dot(offset, normal)) <= kFlatness * lumel.size &&
                      glm::dot(lumel.normal, normal) > 1.0f - kFlatness;
    }
    return shape;
}

/// Viewpoint of the patch: its mean if that surely lies on it, or the lumel nearest to the mean.
std::uint32_t eye_of(const Lumels& lumels, const Range& range, const Shape& shape,
                     std::uint32_t exponent)
{
    const std::uint32_t whole = 1u << (2 * exponent);
    if (shape.flat && range.last - range.first == whole && whole > 1)
        return kFromMean;
    std::uint32_t nearest = range.first;
    for (std::uint32_t i = range.first; i < range.last; ++i)
        if (glm::distance(lumels.lumels[i].position, shape.centre) <
            glm::distance(lumels.lumels[nearest].position, shape.centre))
            nearest = i;
    return nearest;
}

using Groups = std::span<const std::uint32_t>;

bool is_mixed(Groups group, const Range& range)
{
    return !group.empty() &&
           std::any_of(group.begin() + range.first, group.begin() + range.last,
                       [&](std::uint32_t other) { return other != group[range.first]; });
}

/// group: [N], or empty for one group.
void append_patches(const Lumels& lumels, Groups group, const Range& range, std::uint32_t exponent,
                    std::vector<Patch>& patches)
{
    for (std::uint32_t first = range.first; first < range.last;) {
        const Range block = next_block(lumels, first, range.last, exponent);
        first = block.last;
        const bool buried = std::any_of(lumels.lumels.begin() + block.first,
                                        lumels.lumels.begin() + block.last, is_buried);
        const Shape shape = shape_of(lumels, block);
        if (exponent > 0 && (buried || shape.bent || is_mixed(group, block)))
            append_patches(lumels, group, block, exponent - 1, patches);
        else if (!buried)
            patches.push_back({block.first, block.last - block.first,
                               eye_of(lumels, block, shape, exponent), shape.size});
    }
}

bool same_side(const Lumel& a, const Lumel& b)
{
    return a.chart == b.chart && (a.flags & kLumelBack) == (b.flags & kLumelBack);
}

/// The lumels from `first` on that belong to the same side of a chart.
Range next_chart(const Lumels& lumels, std::uint32_t first)
{
    std::uint32_t last = first + 1;
    while (last < lumels.lumels.size() && same_side(lumels.lumels[first], lumels.lumels[last]))
        ++last;
    return {first, last};
}

}  // namespace

std::vector<Patch> make_blocks(const Lumels& lumels, std::span<const std::uint32_t> group)
{
    std::vector<Patch> blocks;
    for (std::uint32_t first = 0; first < lumels.lumels.size();) {
        const Range chart = next_chart(lumels, first);
        append_patches(lumels, group, chart, kBlockLevels, blocks);
        first = chart.last;
    }
    return blocks;
}

Patches make_patches(const Lumels& lumels)
{
    Patches result;
    for (std::uint32_t first = 0; first < lumels.lumels.size();) {
        const std::uint32_t last = next_chart(lumels, first).last;
        PatchChart chart{.first_lumel = first, .lumel_count = last - first};
        chart.moving = (lumels.lumels[first].flags & kLumelMoving) ? 1 : 0;
        for (std::uint32_t level = 0; level < kBlockLevels; ++level) {
            chart.first_patch[level] = std::uint32_t(result.patches.size());
            append_patches(lumels, {}, {first, last}, kBlockLevels - level, result.patches);
            chart.patch_count[level] =
                std::uint32_t(result.patches.size()) - chart.first_patch[level];
        }
        result.charts.push_back(chart);
        first = last;
    }
    return result;
}

std::uint32_t points_per_lumel(std::uint32_t level)
{
    return level <= kLumelLevel ? 1u : 1u << (2 * (level - kLumelLevel));
}

std::uint32_t patches_of(const PatchChart& chart, std::uint32_t level)
{
    return level < kBlockLevels ? chart.patch_count[level]
                                : chart.lumel_count * points_per_lumel(level);
}

Patch patch_of(const Patches& layout, const ChosenPatch& chosen)
{
    const PatchChart& chart = layout.charts[chosen.chart];
    if (chosen.level < kBlockLevels)
        return layout.patches[chart.first_patch[chosen.level] + chosen.index];
    const std::uint32_t lumel = chart.first_lumel + chosen.index / points_per_lumel(chosen.level);
    return {lumel, 1, lumel, 0.0f};
}

}  // namespace lumel
