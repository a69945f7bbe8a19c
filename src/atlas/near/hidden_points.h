#pragma once
// Points of lumels that are shut in by other geometry.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Points near the corners of a piece; of a triangle one twice.
inline constexpr std::size_t kCornersOfPiece = 4;

/// Sides of double-sided charts inside closed solids.
class InnerSides {
public:
    /// The atlas must outlive this.
    InnerSides(const Scene& scene, const Atlas& atlas);

    bool has(const Lumel& lumel) const;
    bool has(const RayHit& hit) const;

private:
    bool is_inner(std::uint32_t chart, bool front) const;

    const Atlas* atlas_;
    std::vector<std::size_t> first_surface_;  ///< [instances]
};

/// Bit k: direction k.
using Directions = std::uint32_t;
inline constexpr std::uint32_t kDirections = 16;  ///< rays per point
inline constexpr Directions kAllDirections = (1u << kDirections) - 1;

/// Tests whether points of a lumel are hidden: all rays from them are shut in, see buried.h. Casts
/// the rays along one direction together. Tries the last successful direction first.
class HiddenPoints {
public:
    /// tried: directions of rays. is_near_back: if rays of the lumel are known to hit backs nearby.
    /// look and inner must outlive this.
    HiddenPoints(const LumelsInScene& look, const InnerSides& inner, std::size_t i,
                 Directions tried, bool is_near_back)
        : look_(look),
          inner_(inner),
          lumel_(i),
          tried_(tried),
          is_near_back_(is_near_back)
    {
    }

    /// hidden [points].
    void operator()(std::span<const LumelPoint> points, std::span<bool> hidden);

    /// Looks whether some of these points of a lumel, at most kCornersOfPiece, are shut in beside
    /// backs nearby: all of its points may be open by the first direction, to a far front.
    void look_for_backs(std::span<const LumelPoint> points);

    /// Directions by which points were first found open.
    Directions successful() const { return successful_; }
    /// True if many rays have hit backs nearby.
    bool is_near_back() const { return is_near_back_; }

private:
    /// Among left_, which then are those that are still hidden. Returns how many rays hit backs
    /// nearby.
    std::size_t find_open(std::span<const LumelPoint> points, std::span<bool> hidden);

    /// Hides points that are open by few fronts, which are shut in themselves, if they meet a back:
    /// as the end of a floor that a wall stands on.
    void find_shut_in(std::span<const LumelPoint> points, std::span<bool> hidden);

    /// True if walks along all of these directions end at backs.
    bool all_end_at_backs(const LumelPoint& point, Directions fronts) const;

    /// True if a back lies at a front that a ray has hit, or a front at a back, as where two solids
    /// touch: which of them the ray has hit is chance.
    bool is_contact(const RaySpan& ray, const RayHit& hit) const;

    /// Replaces a front at a contact by the hit beyond: the back of the next solid tells that the
    /// ray is still inside. Nothing beyond, as behind the wall of a room of sheets, tells nothing.
    void pass_contacts(RaySpan ray, RayHit& hit) const;

    /// Casts rays from the points left_.
    void cast(std::span<const LumelPoint> points, std::uint32_t direction);

    /// Of the hemisphere about a normal.
    glm::vec2 sample(std::uint32_t direction) const;

    RaySpan ray_from(const LumelPoint& point, const glm::vec3& along) const;

    bool is_back(const RayHit& hit) const;

    float nearby() const;  ///< [m]

    /// True if a walk of diffuse reflections that begins along a direction ends at the back of a
    /// surface.
    bool ends_at_back(const LumelPoint& point, std::uint32_t direction) const;

    bool is_open(const glm::vec3& normal, const RaySpan& ray, const RayHit& hit) const;

    const LumelsInScene& look_;
    const InnerSides& inner_;
    std::size_t lumel_;
    Directions tried_, successful_ = 0;
    bool is_near_back_;
    std::uint32_t last_ = 0;
    std::vector<std::uint32_t> left_;      ///< points that are not yet decided
    std::vector<RaySpan> rays_;            ///< [left_]
    std::vector<RayHit> hits_;             ///< [left_]
    std::vector<std::uint32_t> in_doubt_;  ///< points that are open by a front
};

}  // namespace lumel
