#pragma once
// Embree BVHs of a scene: one for static geometry, one per movable instance, and one over all.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rays/cast/embree.h"
#include "scene/values/scene.h"

namespace lumel {

/// A primitive of an instance.
struct TracedPart {
    const Scene* scene = nullptr;
    const Primitive* source = nullptr;
    std::uint32_t instance = 0;
    std::uint32_t primitive = 0;
    std::uint32_t number = 0;         ///< index among all parts
    float winding = 1.0f;             ///< -1: mirrored instance, clockwise vertices at the front
    std::vector<float> longest_edge;  ///< [triangles] world [m]; motion is rigid
    const float* vertices = nullptr;  ///< Embree's, world [m]

    /// Corners of a triangle, world [m].
    std::array<glm::vec3, 3> triangle(std::uint32_t index) const
    {
        const std::uint32_t* corner = source->indices.data() + std::size_t(index) * 3;
        const auto vertex = [&](std::uint32_t k) {
            const float* at = vertices + std::size_t(corner[k]) * 3;
            return glm::vec3(at[0], at[1], at[2]);
        };
        return {vertex(0), vertex(1), vertex(2)};
    }
    glm::vec3 to_world(const glm::vec3& position) const
    {
        return glm::vec3(scene->instances[instance].transform * glm::vec4(position, 1.0f));
    }
};

/// Vertices are in world space, so that hits do not depend on how BVHs are divided.
class EmbreeTrees {
public:
    /// Builds the BVHs of some instances, with separate ones for those that may move. movers
    /// [instances]: 1 if movable; empty: none. filter: decides whether a candidate hit on a surface
    /// that may transmit light counts; the geometry's user pointer is its TracedPart. The scene
    /// must outlive this and not move.
    EmbreeTrees(const Scene& scene, std::span<const std::uint32_t> instances,
                const std::vector<char>& movers, RTCFilterFunctionN filter);
    ~EmbreeTrees();
    EmbreeTrees(const EmbreeTrees&) = delete;
    EmbreeTrees& operator=(const EmbreeTrees&) = delete;

    /// Rebuilds the BVHs of these movable instances at their current transforms, and the top BVH.
    void place(std::span<const std::uint32_t> instances);

    RTCScene top() const { return top_; }  ///< for queries
    const std::vector<TracedPart>& parts() const { return parts_; }
    const TracedPart& part(const RTCHit& hit) const;

    using IsOne = std::function<bool(const TracedPart&, std::uint32_t triangle)>;
    /// True if `is_one` says so of a triangle near a sphere [m]. It is asked of all that meet the
    /// sphere, in any order, perhaps twice, and of some others.
    bool any_triangle(const glm::vec3& centre, float radius, const IsOne& is_one) const;

    /// Memory used by Embree [bytes].
    std::uint64_t bytes() const { return std::uint64_t(bytes_.load()); }

    glm::vec3 low() const { return low_; }  ///< bounding box [m], 0 if empty
    glm::vec3 high() const { return high_; }

private:
    /// Parts that move together.
    struct Tree {
        RTCScene scene = nullptr;
        std::vector<std::uint32_t> parts;  ///< by Embree's geometry ID
    };

    void check(const char* step) const;
    void release();
    RTCScene new_scene(RTCBuildQuality quality) const;
    void add(const Scene& scene, std::uint32_t instance, std::uint32_t primitive,
             RTCFilterFunctionN filter);
    void place(const Tree& tree);
    void join();
    void bound();

    std::atomic<std::int64_t> bytes_ = 0;
    RTCDevice device_ = nullptr;
    std::vector<Tree> trees_;  ///< static geometry first, then one per movable instance
    RTCScene top_ = nullptr;   ///< over all BVHs; the static one if nothing is movable
    std::vector<TracedPart> parts_;
    std::vector<std::uint32_t> tree_of_;  ///< [instances]
    glm::vec3 low_{0.0f}, high_{0.0f};
};

}  // namespace lumel
