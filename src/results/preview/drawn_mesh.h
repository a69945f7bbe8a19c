#pragma once
// World-space triangles of a scene, ordered by material, for the preview's shaders.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Elements [first, last) of an array.
struct Stretch {
    std::size_t first, last;
};

class DrawnMesh {
public:
    struct Range {
        std::uint32_t first, count;
    };

    DrawnMesh(const Scene& scene, const Atlas& atlas);

    /// Updates positions from the instances' transforms; shapes must not change. Returns the
    /// changed range of positions, if any.
    std::optional<Stretch> place(const Scene& scene);

    const std::vector<glm::vec3>& positions() const { return positions_; }
    const std::vector<glm::vec4>& looks() const { return looks_; }  ///< texture coordinates
    const std::vector<glm::vec2>& lightmap() const { return lightmap_; }
    const std::vector<glm::vec4>& colors() const { return colors_; }
    const std::vector<std::uint32_t>& indices() const { return indices_; }
    /// Ranges of indices, by material and kBack…
    const std::map<std::pair<int, std::uint32_t>, Range>& ranges() const { return ranges_; }

    /// Distance to the vertex farthest from a point [m]; at least 1e-6.
    float farthest_from(const glm::vec3& point) const;

private:
    /// Vertices of one side of a surface.
    struct Piece {
        std::uint32_t instance, primitive;
        std::size_t first;                  ///< vertex
        std::vector<std::uint32_t> source;  ///< vertices of the primitive
    };

    void append(const Scene& scene, const Atlas& atlas, const Surface& surface);
    void place(const Scene& scene, const Piece& piece);

    std::vector<glm::vec3> positions_;
    std::vector<glm::vec4> looks_;
    std::vector<glm::vec2> lightmap_;
    std::vector<glm::vec4> colors_;
    std::vector<std::uint32_t> indices_;
    std::map<std::pair<int, std::uint32_t>, Range> ranges_;
    std::vector<Piece> pieces_;
    std::vector<glm::mat4> placed_;  ///< [instances]
};

}  // namespace lumel
