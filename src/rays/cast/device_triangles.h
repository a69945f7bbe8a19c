#pragma once
// The triangles of a scene as devices that trace them number them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"

namespace lumel {

/// Parts of a RayScene that are solid, then those that may let light pass.
class DeviceTriangles {
public:
    explicit DeviceTriangles(const RayScene& rays);

    std::uint32_t solid() const { return solid_; }  ///< triangles
    std::uint32_t count() const { return count_; }  ///< triangles

    struct Place {
        std::size_t part;
        std::uint32_t triangle;  ///< of the part
    };
    Place place(std::uint32_t triangle) const;

    struct Mesh {
        std::vector<glm::vec3> positions;    ///< world [m]
        std::vector<std::uint32_t> corners;  ///< [count][3] of these
    };
    /// Of the scene that this was made for.
    Mesh mesh(const RayScene& rays) const;

private:
    std::vector<std::size_t> parts_;     ///< in the order of their triangles
    std::vector<std::uint32_t> before_;  ///< [parts] triangles
    std::uint32_t solid_ = 0, count_ = 0;
};

}  // namespace lumel
