#pragma once
// Atlas: separate texels for each surface of each instance. Lumels: patches made from texels. On
// the CPU; equal scenes give equal bytes.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/lumel.shared.h"
#include "atlas/packing/pages.h"
#include "base/core/progress_callback.h"
#include "scene/values/scene.h"

namespace lumel {

/// Sides of double-sided surfaces in the map.
enum class Sides {
    automatic,  ///< both, with separate texels, if light may reach both
    both,       ///< both, always
    brighter,   ///< the brighter side, per chart
    front,      ///< the front
};

/// Texel density of nodes, meshes or materials whose name matches `pattern`.
struct DensityRule {
    std::string pattern;  ///< shell wildcards * ? []
    float texels_per_metre = 0.0f;
};

struct AtlasOptions {
    float texels_per_metre = 0.0f;  ///< 0: the highest that fits `size`, or a side of 512 or more
    int size = 0;                   ///< fixed side of the square atlas [texels], 0: free
    int max_size = 4096;            ///< maximum side [texels]; the density is reduced to fit
    int pages = 1;                  ///< maximum number of such maps if one is too small
    int gutter = 2;                 ///< empty texels between any two charts
    Sides sides = Sides::automatic;
    bool daylit = false;                 ///< Sides::automatic counts all of the sky as light
    std::vector<DensityRule> densities;  ///< the last match applies
    bool coarse_afar = false;  ///< fewer texels far from cameras and detail, see density.h
};

/// A primitive of an instance in the atlas. Vertices are split at chart borders.
struct Surface {
    std::uint32_t instance = 0;                ///< index into Scene::instances
    std::uint32_t primitive = 0;               ///< index into its mesh's primitives
    std::vector<std::uint32_t> source_vertex;  ///< [V] index into the primitive's vertex arrays
    std::vector<glm::vec2> texcoord;     ///< [V] atlas position [texels], (0, 0): top left corner
    std::vector<std::uint32_t> indices;  ///< [3T] triangles in the primitive's order
    std::vector<std::uint32_t> chart;    ///< [T] global chart index
    bool authored = false;               ///< from the file's TEXCOORD_1
    float texels_per_metre = 0.0f;       ///< its density; 0 in an atlas read from a file
};

struct Atlas {
    int width = 0;                  ///< [texels]
    int height = 0;                 ///< [texels]
    Pages pages;                    ///< pages of the files
    float texels_per_metre = 0.0f;  ///< density near the content, unless a rule applies
    std::uint32_t chart_count = 0;
    std::vector<Surface> surfaces;  ///< in order of instance, then primitive
    /// [chart_count] Offset from a chart's front to its back in the map [texels], 0 if both share
    /// texels; or empty.
    std::vector<glm::ivec2> back_shift;
    /// [chart_count] Sides of double-sided charts inside closed solids: front, back; or empty.
    std::vector<std::array<bool, 2>> inner;
    bool shows_front = false;        ///< shared texels show the front, not the brighter side
    std::vector<std::string> notes;  ///< messages for the user: overlaps, reduced density, …
};

/// A triangle of an instance.
struct TriangleOf {
    std::uint32_t instance, primitive, triangle;
};

/// The two sides of a double-sided chart.
struct ChartSides {
    bool shows_both = false;      ///< each gets its own texels
    std::array<bool, 2> inner{};  ///< front, back: inside a closed solid
};

/// Looks at the sides of charts, given by their triangles [charts]. Called before packing. A chart
/// may also be a whole layout of the file.
using FindSides =
    std::function<std::vector<ChartSides>(const Scene&, std::span<const std::vector<TriangleOf>>)>;

/// Builds the atlas. Charts have whole texel sizes, so that edges of rectangles coincide with texel
/// edges; parts thinner than a texel share a neighbour's texels. Throws Error{input} if it cannot
/// fit. find_sides: if empty, sides share texels.
Atlas make_atlas(const Scene& scene, const AtlasOptions& options,
                 const ProgressCallback& progress = {}, const FindSides& find_sides = {});

/// The patches of the radiosity equation, in Morton order within charts.
struct Lumels {
    int width = 0;  ///< atlas size [texels]
    int height = 0;
    std::vector<Lumel> lumels;    ///< [N] front lumels, and back lumels of double-sided surfaces
    std::vector<Gloss> gloss;     ///< [N] gloss of their materials
    std::vector<float> edge;      ///< [N] longest edge of the triangles below, world [m]; or empty
    std::vector<Piece> pieces;    ///< [P]
    std::vector<float> coverage;  ///< [height][width] covered share × opacity, 0…1
    std::vector<glm::ivec2> back_shift;  ///< as in Atlas
    bool shows_front = false;            ///< as in Atlas
};

/// Makes a lumel of every covered texel, however thinly covered. If charts of the file share a
/// texel, it belongs to the one with the largest part.
Lumels make_lumels(const Scene& scene, const Atlas& atlas, const ProgressCallback& progress = {});

/// [texels][2]: front and back lumel of each texel, or kNoLumel.
std::vector<std::uint32_t> lumels_by_side(const Lumels& lumels);

}  // namespace lumel
