#pragma once
// Rays on the host, through Embree: who hits what. Knows geometry and opacity, no light.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/scene.h"

namespace lumel {

class EmbreeTrees;

/// What lies along a ray counts from `near` to `far`. One whose ends have met is clear.
struct RaySpan {
    glm::vec3 origin{0.0f};     ///< [m]
    float near = 0.0f;          ///< [m]
    glm::vec3 direction{0.0f};  ///< unit
    float far = 0.0f;           ///< [m]
    std::uint32_t seed = 0;     ///< of what surfaces let pass
};

/// From one point to another, both ends shortened by `offset` [m].
RaySpan ray_between(const glm::vec3& from, const glm::vec3& to, float offset, std::uint32_t seed);

/// Along a unit direction, however far.
RaySpan ray_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed);

/// Where a ray meets the scene.
struct RayHit {
    std::uint32_t instance = 0;   ///< index into Scene::instances
    std::uint32_t primitive = 0;  ///< index into the instance's mesh.primitives
    std::uint32_t triangle = 0;   ///< index into Primitive::indices / 3
    glm::vec2 barycentric{0.0f};  ///< weights of the triangle's 2nd and 3rd vertex
    float distance = 0.0f;        ///< [m], direction must be unit length
    glm::vec3 normal{0.0f};  ///< geometric, unit, world, outward by winding (flipped by mirroring)
    bool front = true;       ///< the ray came from the side the normal points to
    /// Product of the tints of all glass that the ray passed, also where it then met nothing.
    glm::vec3 tint{1.0f};
};

/// All triangles of a scene in world space. Safe to query from many threads at once.
/// Reads materials and textures while it is queried, so the scene must outlive it, unmoved.
/// MASK surfaces are cut out exactly; BLEND surfaces and glass are hit with the probability of
/// their opacity, drawn from a hash of `seed` and the triangle, so a query with the same seed has
/// the same answer. What passes glass has its tint.
class RayScene {
public:
    /// Throws Error{device} if Embree cannot build its tree (out of memory).
    explicit RayScene(const Scene& scene);
    /// Of some of its instances alone.
    RayScene(const Scene& scene, std::span<const std::uint32_t> instances);
    /// Of all, those that may move [instances] (1) in trees of their own.
    RayScene(const Scene& scene, const std::vector<char>& movers);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Takes some of those that may move from where the scene has them now: only their trees, and
    /// one over all trees, are built again. Rays then meet what they meet in a new RayScene; of two
    /// surfaces in one plane they may meet the other. Nothing may query meanwhile.
    void place(std::span<const std::uint32_t> instances);

    /// True if nothing lies between the two points (both ends are shortened by `offset` [m]).
    bool sees(const glm::vec3& from, const glm::vec3& to, float offset, std::uint32_t seed) const;

    /// True if nothing lies along a unit direction, however far.
    bool sees_out(const glm::vec3& from, const glm::vec3& direction, std::uint32_t seed) const;

    /// The part of light that passes from one point to the other, or out along a unit direction:
    /// 0 if something is hit, else the product of the tints.
    glm::vec3 transmittance(const glm::vec3& from, const glm::vec3& to, float offset,
                            std::uint32_t seed) const;
    glm::vec3 transmittance_out(const glm::vec3& from, const glm::vec3& direction,
                                std::uint32_t seed) const;
    glm::vec3 transmittance(const RaySpan& ray) const;

    /// First hit along a unit direction with distance in (near, far), or false.
    bool closest(const glm::vec3& origin, const glm::vec3& direction, float near, float far,
                 std::uint32_t seed, RayHit& hit) const;
    bool closest(const RaySpan& ray, RayHit& hit) const
    {
        return closest(ray.origin, ray.direction, ray.near, ray.far, ray.seed, hit);
    }

    /// The triangles as who traces them elsewhere needs them: a part for each primitive of each
    /// instance that has any.
    std::size_t parts() const;
    std::vector<glm::vec3> positions(std::size_t part) const;        ///< of vertices, world [m]
    std::span<const std::uint32_t> corners(std::size_t part) const;  ///< [triangles][3] of these
    bool may_let_pass(std::size_t part) const;                       ///< MASK, BLEND or glass

    /// The tint of what passes a triangle at a point of it; empty if a ray of this seed meets it.
    std::optional<glm::vec3> transmittance(std::size_t part, std::uint32_t triangle,
                                           const glm::vec2& barycentric, std::uint32_t seed) const;

    /// A hit, by what is known of it.
    RayHit hit(std::size_t part, std::uint32_t triangle, const glm::vec2& barycentric,
               float distance, const glm::vec3& direction) const;

    /// Corners of the world-space bounding box [m]; both 0 for a scene without triangles.
    glm::vec3 low() const;
    glm::vec3 high() const;

    /// That its trees take.
    std::uint64_t bytes() const;

    /// How far off a surface that was hit rays should start, so as to miss it [m].
    float ray_offset() const;

private:
    RayScene(const Scene& scene, std::span<const std::uint32_t> instances,
             const std::vector<char>& movers);
    std::unique_ptr<EmbreeTrees> trees_;
};

/// Of the library that traces the rays: "3.13.5".
std::string embree_version();

}  // namespace lumel
