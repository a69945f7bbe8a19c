#pragma once
// Vulkan acceleration structures over triangles, for ray queries.

#include <memory>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "gpu/array.h"

namespace lumel::gpu {

/// Built once, for static triangles. Shaders use it by ray queries; the geometry index is that of
/// the triangle list.
class TriangleTree {
public:
    /// Indices of three positions per triangle.
    struct Triangles {
        std::span<const std::uint32_t> corners;  ///< [triangles][3]
        bool opaque = true;  ///< false: queries report them as candidates and decide
    };

    /// positions: [m] for all lists. Lists may be empty. Throws Error{device} if the device lacks
    /// ray queries (Device::can_query_rays) or memory.
    TriangleTree(const Device& device, std::span<const glm::vec3> positions,
                 std::span<const Triangles> lists);

    VkAccelerationStructureKHR handle() const { return top_->handle(); }

private:
    /// An acceleration structure with its memory.
    class Level {
    public:
        Level(const Device& device, VkAccelerationStructureTypeKHR type,
              std::span<const VkAccelerationStructureGeometryKHR> geometries,
              std::span<const VkAccelerationStructureBuildRangeInfoKHR> ranges);
        ~Level();
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

        VkAccelerationStructureKHR handle() const { return handle_; }

    private:
        void build(VkAccelerationStructureBuildGeometryInfoKHR what, std::uint64_t scratch_bytes,
                   std::span<const VkAccelerationStructureBuildRangeInfoKHR> ranges) const;

        const Device& device_;
        std::optional<Buffer> memory_;
        VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
    };

    void add_bottom(const Device& device, std::span<const glm::vec3> positions,
                    std::span<const Triangles> lists);
    void add_top(const Device& device);

    std::unique_ptr<Level> bottom_;  ///< over the triangles
    std::unique_ptr<Level> top_;     ///< over bottom_
};

}  // namespace lumel::gpu
