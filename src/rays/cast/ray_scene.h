#pragma once
// Rays on the CPU, by Embree. Handles geometry and opacity, no light.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/scene.h"

namespace lumel {

class EmbreeTrees;

/// Ray segment: hits count between `near` and `far`. Unoccluded if far ≤ near.
struct RaySpan {
    glm::vec3 origin{0.0f};     ///< [m]
    float near = 0.0f;          ///< [m]
    glm::vec3 direction{0.0f};  ///< unit
    float far = 0.0f;           ///< [m]
    std::uint32_t seed = 0;     ///< random choices of transparent surfaces
};

/// Segment between two points, both ends shortened by `offset` [m].
RaySpan ray_between(const glm::vec3& from, const glm::vec3& to, float offset, std::uint32_t seed);

/// Offset of ray origins from a surface, so that rays do not hit it again [m]. reach: largest
/// coordinate of the origin, edge of its triangle, or length of the ray that found it [m]: what
/// rounding errors are proportional to.
float ray_offset_for(float reach);

/// Largest coordinate [m].
float largest_coordinate(const glm::vec3& position);

/// Longest edge of a triangle [m].
float longest_edge(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Ray along a unit direction, of infinite length.
RaySpan ray_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed);

/// Hit of a ray.
struct RayHit {
    std::uint32_t instance = 0;   ///< index into Scene::instances
    std::uint32_t primitive = 0;  ///< index into the instance's mesh.primitives
    std::uint32_t triangle = 0;   ///< index into Primitive::indices / 3
    glm::vec2 barycentric{0.0f};  ///< weights of the triangle's 2nd and 3rd vertex
    float distance = 0.0f;        ///< [m], direction must be unit length
    glm::vec3 normal{0.0f};   ///< geometric, unit, world, outward by winding (flipped by mirroring)
    bool front = true;        ///< hit from the side of the normal
    float ray_offset = 0.0f;  ///< of rays that start here [m], see ray_offset_for()
    /// Product of the tints of all glass passed, valid even without a hit.
    glm::vec3 tint{1.0f};
};

/// All triangles of a scene in world space. Queries are thread-safe. They read materials and
/// textures, so the scene must outlive this and not move. MASK surfaces are cut out exactly. BLEND
/// surfaces and glass are hit with the probability of their opacity, by a hash of `seed` and the
/// triangle: equal seeds give equal results. Light that passes glass has its tint.
class RayScene {
public:
    /// Throws Error{device} if Embree cannot build its BVH (out of memory).
    explicit RayScene(const Scene& scene);
    /// Uses only these instances.
    RayScene(const Scene& scene, std::span<const std::uint32_t> instances);
    /// movers [instances]: 1 if movable; each has its own BVH.
    RayScene(const Scene& scene, const std::vector<char>& movers);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Applies the current transforms of these movable instances. Rebuilds only their BVHs and the
    /// top one. Hits then equal those of a new RayScene, except between coplanar surfaces. No query
    /// may run meanwhile.
    void place(std::span<const std::uint32_t> instances);

    /// True if the segment between the points, shortened by `offset` [m] at both ends, is
    /// unoccluded.
    bool sees(const glm::vec3& from, const glm::vec3& to, float offset, std::uint32_t seed) const;

    /// True if the ray along a unit direction is unoccluded.
    bool sees_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed) const;

    /// Transmittance between two points, or out along a unit direction: 0 if a surface is hit, else
    /// the product of the tints.
    glm::vec3 transmittance(const glm::vec3& from, const glm::vec3& to, float offset,
                            std::uint32_t seed) const;
    glm::vec3 transmittance_out(const glm::vec3& from, const glm::vec3& direction,
                                std::uint32_t seed) const;
    glm::vec3 transmittance(const RaySpan& ray) const;
    /// Of many rays, in packets: faster, above all for rays from near places to one lamp. Each is
    /// as that of the ray alone.
    void transmittance(std::span<const RaySpan> rays, std::span<glm::vec3> transmittance) const;

    /// Finds the closest hit along a unit direction within (near, far). Returns false if there is
    /// none.
    bool closest(const glm::vec3& origin, const glm::vec3& direction, float near, float far,
                 std::uint32_t seed, RayHit& hit) const;
    bool closest(const RaySpan& ray, RayHit& hit) const
    {
        return closest(ray.origin, ray.direction, ray.near, ray.far, ray.seed, hit);
    }

    /// Finds the closest hits of rays in packets: faster if rays are parallel and close. hits
    /// [rays]: with an infinite distance if there is none. Where surfaces coincide, the one that is
    /// hit can depend on the other rays.
    void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const;

    /// True if no triangle within `radius` of a point rises more than `height` above the plane
    /// through it, across the unit normal [m].
    bool is_clear_above(const glm::vec3& point, const glm::vec3& normal, float radius,
                        float height) const;

    /// True if `is_one` says so of a surface within `radius` of a point [m]. hit: the surface, as
    /// a ray along `direction` hits it, without the place and what depends on it.
    bool any_at(const glm::vec3& point, float radius, const glm::vec3& direction,
                const std::function<bool(const RayHit& hit)>& is_one) const;

    /// Triangles for other ray tracing backends: one part per primitive of each instance.
    std::size_t parts() const;
    std::vector<glm::vec3> positions(std::size_t part) const;        ///< vertices, world [m]
    std::span<const std::uint32_t> corners(std::size_t part) const;  ///< [triangles][3] indices
    bool may_let_pass(std::size_t part) const;                       ///< MASK, BLEND or glass

    /// Builds a RayHit from its parameters.
    RayHit hit(std::size_t part, std::uint32_t triangle, const glm::vec2& barycentric,
               float distance, const glm::vec3& direction) const;

    /// Offset of rays that start at a point [m], which may lie on a surface facing `normal`.
    float ray_offset(const glm::vec3& position, const glm::vec3& normal) const;

    /// Corners of the world-space bounding box [m]; both 0 for a scene without triangles.
    glm::vec3 low() const;
    glm::vec3 high() const;

    /// Memory of the BVHs [bytes].
    std::uint64_t bytes() const;

    /// Upper bound of the ray offsets in this scene [m].
    float ray_offset() const;

private:
    RayScene(const Scene& scene, std::span<const std::uint32_t> instances,
             const std::vector<char>& movers);
    std::unique_ptr<EmbreeTrees> trees_;
};

/// Version of the ray tracing library: "3.13.5".
std::string embree_version();

}  // namespace lumel
