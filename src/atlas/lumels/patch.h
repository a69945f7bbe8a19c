#pragma once
// Surface fragments under one texel, from which its lumel is built.

#include <array>
#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"
#include "atlas/packing/atlas.h"

namespace lumel {

/// A triangle of the atlas, with the affine map from texels to its instance.
struct TexelTriangle {
    TexelTriangle(const Scene& scene, const Surface& surface, std::uint32_t triangle);

    glm::dvec3 weights(const glm::dvec2& texel) const;  ///< weights of the three corners
    glm::dvec3 position(const glm::dvec2& texel) const;

    Polygon plane;                          ///< [texels]
    std::array<std::uint32_t, 3> source{};  ///< vertex indices in the primitive
    std::array<glm::dvec3, 3> corner;       ///< [m] instance frame
    glm::dvec3 front;                       ///< unit geometric normal, instance frame
    double world_area = 0.0;                ///< [m²]
    bool collapsed = false;                 ///< (almost) no area in the atlas
};

/// The part of a triangle in one texel.
struct Part {
    TexelTriangle triangle;
    const Surface* surface;
    const Primitive* primitive;
    const Material* material;
    Polygon polygon;    ///< [texels]; if collapsed: weights of the 2nd and 3rd corner
    double world_area;  ///< [m²]

    glm::dvec3 weights(const glm::dvec2& point) const;
    glm::dvec3 position(const glm::dvec2& point) const;
};

/// Clips the triangle to the texel.
Part make_part(const Scene& scene, const Surface& surface, std::uint32_t triangle, int x, int y);

/// Unit normal at a point of a part, instance frame: the interpolated vertex normal if plausible,
/// else the geometric one.
glm::dvec3 normal_at(const Part& part, const glm::dvec2& point);

/// Divides the parts into front-facing pieces, only the largest if there are too many. Shares are
/// running sums that end at 1.
std::vector<Piece> cut_into_pieces(const std::vector<Part>& parts, int x, int y);

/// The point of the pieces nearest to `point`.
glm::dvec3 nearest_on(const std::vector<Piece>& pieces, const glm::dvec3& point);

/// Area-weighted material of the parts.
struct Look {
    glm::dvec3 albedo{0.0}, diffuse{0.0}, specular{0.0};
    double roughness = 0.0;
    glm::dvec3 luminance{0.0};  ///< [cd/m²]
    double opacity = 0.0;       ///< area-weighted mean
    double area = 0.0;          ///< [m²] represented by the samples
};
Look mean_look(const Scene& scene, const std::vector<Part>& parts, int x, int y);

}  // namespace lumel
