#pragma once
// Lumels in world space, for geometry.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/lumels/sampling.h"
#include "atlas/near/gauss.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// Maximum points along a side of a lumel.
inline constexpr int kMaxSide = 16;

/// Seed of rays through blended surfaces; any value serves.
inline constexpr std::uint32_t kBlendSeed = 0;

/// A piece of a lumel in world space; corners counter-clockwise at its front.
struct Facet {
    glm::vec3 corner[4];
    int count = 0;  ///< 3 or 4
};

struct WorldLumel {
    glm::vec3 centre;               ///< [m]
    glm::vec3 normal;               ///< unit, mean over the lumel
    float size = 0.0f;              ///< [m]
    float reach = 0.0f;             ///< [m] of its triangles, see ray_offset_for()
    float ray_offset = 0.0f;        ///< [m] offset of ray origins for exact form factors
    float opacity = 1.0f;           ///< area / area of its facets: below 1 if cut out
    bool flat = false;              ///< all facets lie in the plane through `centre` with `normal`
    std::uint32_t first_facet = 0;  ///< also index of the first piece
    std::uint32_t facet_count = 0;
};

/// A point of a lumel in world space, and its share of the lumel.
struct WeightedPoint {
    LumelPoint point;
    float weight;
};

class WorldLumels {
public:
    WorldLumels(const Scene& scene, const RayScene& rays, const Lumels& lumels);

    /// Sets the scene's current size, for lumels of unknown triangles that are placed from now on.
    void fit(const RayScene& rays);

    /// True if the lumel is flat and nothing rises above it within its size.
    bool is_clear(std::size_t i, const RayScene& rays) const;

    /// Updates some lumels to the current transforms of their instances.
    void place(const Scene& scene, const Lumels& lumels, std::span<const std::uint32_t> chosen);

    std::size_t size() const { return lumels_.size(); }
    const WorldLumel& operator[](std::size_t i) const { return lumels_[i]; }
    const Facet* begin(const WorldLumel& lumel) const { return &facets_[lumel.first_facet]; }
    const Facet* end(const WorldLumel& lumel) const { return begin(lumel) + lumel.facet_count; }

    /// The pieces of a lumel in world space.
    std::span<const Piece> pieces(const WorldLumel& lumel) const
    {
        return std::span(pieces_).subspan(lumel.first_facet, lumel.facet_count);
    }

    /// Maps (s, t) in the unit square to a point of lumel i and its normal, in world space.
    LumelPoint point_on(std::size_t i, const glm::vec2& st) const
    {
        return lumel::point_on(pieces(lumels_[i]), st.x, st.y);
    }

    /// About side × side quadrature points of lumel i: Gauss points of each piece, or stratified
    /// points if it has more pieces. side ≤ kMaxSide.
    std::vector<WeightedPoint> gauss_points(std::size_t i, int side) const;

    /// Its centroid, repeated side × side times.
    std::vector<WeightedPoint> centroids(std::size_t i, int side) const;

private:
    struct Placement {
        glm::mat4 points;
        glm::mat3 normals;
    };

    static std::vector<Placement> placements_of(const Scene& scene);
    void place(std::size_t i, const Lumels& lumels, const Placement& placement);
    void place_facets(std::size_t i, const Lumel& lumel, const Piece* local,
                      const Placement& placement);

    float extent_;  ///< [m] reach of the whole scene, for lumels of unknown triangles
    std::vector<std::vector<GaussPoint>> rules_;  ///< [count - 1] rule of that many points
    std::vector<WorldLumel> lumels_;
    std::vector<Piece> pieces_;
    std::vector<Facet> facets_;  ///< one per piece, same index
};

/// Lumels and what surrounds them; all must outlive this.
struct LumelsInScene {
    const Scene& scene;
    const RayScene& rays;
    const WorldLumels& world;
    const Lumels& lumels;
};

}  // namespace lumel
