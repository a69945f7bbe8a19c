#pragma once
// From meshes to an atlas: every instance of every surface gets texels of its own. And from
// texels to lumels. On the CPU, and the same scene gives the same bytes.

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

/// What the map shows of double-sided surfaces.
enum class Sides {
    automatic,  ///< both, in texels of their own, where light may reach both
    both,       ///< both, everywhere
    brighter,   ///< one: chart by chart the side that is brighter on the whole
    front,      ///< one: the front
};

/// The density of what is named so.
struct DensityRule {
    std::string pattern;  ///< of names of nodes, meshes or materials, as the shell's: * ? []
    float texels_per_metre = 0.0f;
};

struct AtlasOptions {
    float texels_per_metre = 0.0f;  ///< 0: as dense as fits `size`, or a side of 512 and more
    int size = 0;                   ///< fixes the side of the square atlas [texels], 0: free
    int max_size = 4096;            ///< largest side allowed [texels]; density is scaled to fit
    int pages = 1;                  ///< most maps of that side to use where one is too small
    int gutter = 2;                 ///< empty texels kept between any two charts
    Sides sides = Sides::automatic;
    std::vector<DensityRule> densities;  ///< of two that fit, the later one counts
    bool coarse_afar = false;  ///< fewer texels far from cameras and detail, see density.h
};

/// One primitive of one instance, laid out in the atlas. Vertices are split at chart borders.
struct Surface {
    std::uint32_t instance = 0;                ///< index into Scene::instances
    std::uint32_t primitive = 0;               ///< index into its mesh's primitives
    std::vector<std::uint32_t> source_vertex;  ///< [V] index into the primitive's vertex arrays
    std::vector<glm::vec2> texcoord;     ///< [V] atlas place [texels], (0, 0): top left corner
    std::vector<std::uint32_t> indices;  ///< [3T] same triangles, same order as the primitive
    std::vector<std::uint32_t> chart;    ///< [T] chart of each triangle, global index
    bool authored = false;               ///< laid out by the file's TEXCOORD_1
    float texels_per_metre = 0.0f;       ///< its density; 0 in an atlas that was written before
};

struct Atlas {
    int width = 0;                  ///< [texels]
    int height = 0;                 ///< [texels]
    Pages pages;                    ///< that it is written as
    float texels_per_metre = 0.0f;  ///< density where people look and none is set
    std::uint32_t chart_count = 0;
    std::vector<Surface> surfaces;  ///< in order of instance, then primitive
    /// [chart_count], or empty: where the map has the light of a chart's back, counted from its
    /// front [texels]; 0 where both sides share their texels.
    std::vector<glm::ivec2> back_shift;
    bool shows_front = false;        ///< shared texels show the front, not the brighter side
    std::vector<std::string> notes;  ///< sentences for the user: overlaps, scaled density, …
};

/// A triangle of an instance.
struct TriangleOf {
    std::uint32_t instance, primitive, triangle;
};

/// Which charts, each given by its triangles, show both sides in texels of their own [charts].
/// Asked before the map is packed. A chart may also be a whole layout of the file's.
using ShowsBoth =
    std::function<std::vector<char>(const Scene&, std::span<const std::vector<TriangleOf>>)>;

/// Lays the scene out. Charts are whole texels wide and high, so that the edges of rectangles
/// coincide with edges of texels; parts thinner than a texel share the texels of a neighbour.
/// Throws Error{input} if it cannot be made to fit. shows_both: if empty, sides share texels.
Atlas make_atlas(const Scene& scene, const AtlasOptions& options,
                 const ProgressCallback& progress = {}, const ShowsBoth& shows_both = {});

/// The patches of the radiosity equation, in Morton order within charts.
struct Lumels {
    int width = 0;  ///< of the atlas [texels]
    int height = 0;
    std::vector<Lumel> lumels;    ///< [N] front lumels, and back lumels of double-sided surfaces
    std::vector<Gloss> gloss;     ///< [N] gloss of their materials
    std::vector<Piece> pieces;    ///< [P]
    std::vector<float> coverage;  ///< [height][width] covered share × opacity of each texel, 0…1
    std::vector<glm::ivec2> back_shift;  ///< as of the atlas
    bool shows_front = false;            ///< as of the atlas
};

/// Lifts every covered texel, however thinly covered, into a lumel. Where charts of a file's own
/// layout meet in one texel, it belongs to the one that covers most of it.
Lumels make_lumels(const Scene& scene, const Atlas& atlas, const ProgressCallback& progress = {});

/// [texels][2]: front and back lumel of each texel, or kNoLumel.
std::vector<std::uint32_t> lumels_by_side(const Lumels& lumels);

}  // namespace lumel
