#pragma once
// Embree's trees over the triangles of a scene: one over what stays, one over each instance that
// may move, and one over all of these.

#include <atomic>
#include <cstdint>
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
    std::uint32_t number = 0;  ///< of all parts
    float winding = 1.0f;  ///< -1: the instance mirrors, the front is where vertices run clockwise

    glm::vec3 to_world(const glm::vec3& position) const
    {
        return glm::vec3(scene->instances[instance].transform * glm::vec4(position, 1.0f));
    }
};

/// All vertices are in the world, so that a ray meets the same however the trees are divided.
class EmbreeTrees {
public:
    /// Of some instances, those among them that may move [instances] (1; empty: none) in trees of
    /// their own. filter: decides whether a candidate hit on a surface that may let light pass
    /// counts; the geometry's user pointer is its TracedPart. The scene must outlive this, unmoved.
    EmbreeTrees(const Scene& scene, std::span<const std::uint32_t> instances,
                const std::vector<char>& movers, RTCFilterFunctionN filter);
    ~EmbreeTrees();
    EmbreeTrees(const EmbreeTrees&) = delete;
    EmbreeTrees& operator=(const EmbreeTrees&) = delete;

    /// Builds the trees of some that may move from where they are now, and that over all.
    void place(std::span<const std::uint32_t> instances);

    RTCScene top() const { return top_; }  ///< for queries
    const std::vector<TracedPart>& parts() const { return parts_; }
    const TracedPart& part(const RTCHit& hit) const;

    /// Bytes that Embree holds.
    std::uint64_t bytes() const { return std::uint64_t(bytes_.load()); }

    glm::vec3 low() const { return low_; }  ///< corners of the bounding box [m], 0 if there is none
    glm::vec3 high() const { return high_; }

private:
    /// Parts that move together.
    struct Tree {
        RTCScene scene = nullptr;
        std::vector<std::uint32_t> parts;  ///< by Embree's geometry number
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
    std::vector<Tree> trees_;  ///< the first of what stays, the others of an instance each
    RTCScene top_ = nullptr;   ///< of all trees, or the first of them where nothing may move
    std::vector<TracedPart> parts_;
    std::vector<std::uint32_t> tree_of_;  ///< [instances]
    glm::vec3 low_{0.0f}, high_{0.0f};
};

}  // namespace lumel
