#pragma once
// A scene as triangles of the world, ordered by material, as the preview's shaders take them.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Of an array: elements [first, last).
struct Stretch {
    std::size_t first, last;
};

class DrawnMesh {
public:
    struct Range {
        std::uint32_t first, count;
    };

    DrawnMesh(const Scene& scene, const Atlas& atlas);

    /// Takes instances to where the scene has them now; their shapes stay. What has changed of the
    /// positions, if anything has.
    std::optional<Stretch> place(const Scene& scene);

    const std::vector<glm::vec3>& positions() const { return positions_; }
    const std::vector<glm::vec4>& looks() const { return looks_; }  ///< places in textures
    const std::vector<glm::vec2>& lightmap() const { return lightmap_; }
    const std::vector<glm::vec4>& colors() const { return colors_; }
    const std::vector<std::uint32_t>& indices() const { return indices_; }
    /// Of indices, by material and kBack…
    const std::map<std::pair<int, std::uint32_t>, Range>& ranges() const { return ranges_; }

    /// To the vertex that is farthest from a point [m]; 1e-6 at least.
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
