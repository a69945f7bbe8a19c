#pragma once
// What lies under one texel, before it becomes a lumel.

#include <array>
#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"
#include "atlas/packing/atlas.h"

namespace lumel {

/// One triangle of the atlas, with the affine map from the plane of texels to its instance.
struct TexelTriangle {
    TexelTriangle(const Scene& scene, const Surface& surface, std::uint32_t triangle);

    glm::dvec3 weights(const glm::dvec2& texel) const;  ///< of the three corners
    glm::dvec3 position(const glm::dvec2& texel) const;

    Polygon plane;                          ///< [texels]
    std::array<std::uint32_t, 3> source{};  ///< vertices of the primitive
    std::array<glm::dvec3, 3> corner;       ///< [m] instance frame
    glm::dvec3 front;                       ///< unit geometric normal by winding, instance frame
    double world_area = 0.0;                ///< [m²]
    bool collapsed = false;                 ///< has no area in the plane, or next to none
};

/// The part of a triangle that lies in one texel.
struct Part {
    TexelTriangle triangle;
    const Surface* surface;
    const Primitive* primitive;
    const Material* material;
    Polygon polygon;    ///< [texels]; of a collapsed triangle: all of it, as weights of the 2nd
                        ///< and 3rd corner
    double world_area;  ///< [m²]

    glm::dvec3 weights(const glm::dvec2& point) const;
    glm::dvec3 position(const glm::dvec2& point) const;
};

/// Clips the triangle to the texel.
Part make_part(const Scene& scene, const Surface& surface, std::uint32_t triangle, int x, int y);

/// Unit normal at a point of a part, instance frame: the interpolated vertex normal where that
/// makes sense, else the geometric one.
glm::dvec3 normal_at(const Part& part, const glm::dvec2& point);

/// Cuts the parts into pieces facing front, the largest few if there are too many of them.
/// Shares are running sums, 1 at the end.
std::vector<Piece> cut_into_pieces(const std::vector<Part>& parts, int x, int y);

/// The point of the pieces that is nearest to `point`.
glm::dvec3 nearest_on(const std::vector<Piece>& pieces, const glm::dvec3& point);

/// Area-weighted look of the parts.
struct Look {
    glm::dvec3 albedo{0.0}, diffuse{0.0}, specular{0.0};
    double roughness = 0.0;
    glm::dvec3 luminance{0.0};  ///< [cd/m²]
    double opacity = 0.0;       ///< mean over the area
    double area = 0.0;          ///< [m²] that the samples stand for
};
Look mean_look(const Scene& scene, const std::vector<Part>& parts, int x, int y);

}  // namespace lumel
