#pragma once
// Triangle numbering of a scene for GPU ray tracing.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"

namespace lumel {

/// All solid parts of a RayScene, followed by those that may transmit light.
class DeviceTriangles {
public:
    explicit DeviceTriangles(const RayScene& rays);

    std::uint32_t solid() const { return solid_; }  ///< triangles
    std::uint32_t count() const { return count_; }  ///< triangles

    /// Hit that the device found.
    struct DeviceHit {
        std::uint32_t triangle;
        float distance;         ///< [m]
        glm::vec2 barycentric;  ///< weights of its 2nd and 3rd vertex
    };
    /// The hit of that ray. If the triangle may transmit light, the host casts the ray again, so
    /// that all casters decide alike. rays: the scene given to the constructor.
    RayHit hit(const RayScene& rays, const RaySpan& ray, const DeviceHit& found) const;

    struct Mesh {
        std::vector<glm::vec3> positions;    ///< world [m]
        std::vector<std::uint32_t> corners;  ///< [count][3] indices of positions
    };
    /// World-space mesh. rays: the scene given to the constructor.
    Mesh mesh(const RayScene& rays) const;

private:
    struct Place {
        std::size_t part;
        std::uint32_t triangle;  ///< in its part
    };
    Place place(std::uint32_t triangle) const;

    std::vector<std::size_t> parts_;     ///< in the order of their triangles
    std::vector<std::uint32_t> before_;  ///< [parts] triangles before the part
    std::uint32_t solid_ = 0, count_ = 0;
};

}  // namespace lumel
