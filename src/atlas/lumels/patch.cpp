#include "atlas/lumels/patch.h"

#include <algorithm>
#include <cmath>

namespace lumel {

namespace {

// Triangles thinner than this in texel space have no usable inverse map.
constexpr double kCollapsedArea = 1e-10;  // [texels²]
// Interpolated normals beyond this angle to the surface are artefacts.
const double kCosNormal = std::cos(glm::radians(75.0));
// Two maps are equal if they agree to this share of a texel's edge over the texel.
constexpr double kSameMap = 1e-3;
// Tolerance for parallelograms and filled rectangles, relative to a texel.
constexpr double kSameShape = 1e-5;
// Merged parts must have normals within about 2.5 degrees.
constexpr double kCosSameNormal = 0.999;
// Sufficient for uniform sampling of a lumel on a finely meshed surface.
constexpr std::size_t kMaxPieces = 32;

Piece make_piece(const Part& part, const glm::dvec2& origin, const glm::dvec2& u,
                 const glm::dvec2& v, bool parallelogram, double area)
{
    const glm::dvec3 base = part.position(origin);
    glm::dvec3 edge_u = part.position(u) - base, edge_v = part.position(v) - base;
    if (glm::dot(glm::cross(edge_u, edge_v), part.triangle.front) < 0.0)
        std::swap(edge_u, edge_v);
    const glm::dvec2 centre = parallelogram ? 0.5 * (u + v) : (origin + u + v) / 3.0;
    Piece piece{};
    piece.origin = base;
    piece.edge_u = edge_u;
    piece.edge_v = edge_v;
    piece.normal = normal_at(part, centre);
    piece.share = float(area);
    piece.parallelogram = parallelogram ? 1u : 0u;
    return piece;
}

bool is_parallelogram(const Polygon& polygon)
{
    if (polygon.count != 4)
        return false;
    const glm::dvec2 gap =
        polygon.corner[0] + polygon.corner[2] - polygon.corner[1] - polygon.corner[3];
    return std::max(std::abs(gap.x), std::abs(gap.y)) < kSameShape;
}

void cut(const Part& part, std::vector<Piece>& pieces)
{
    const Polygon& polygon = part.polygon;
    const double whole = polygon.area();
    if (is_parallelogram(polygon)) {
        pieces.push_back(make_piece(part, polygon.corner[0], polygon.corner[1], polygon.corner[3],
                                    true, part.world_area));
        return;
    }
    for (int i = 2; i < polygon.count; ++i) {
        const glm::dvec2 &a = polygon.corner[0], &b = polygon.corner[i - 1], &c = polygon.corner[i];
        const double share = 0.5 * std::abs(cross(b - a, c - a)) / whole;
        if (share > 0.0)
            pieces.push_back(make_piece(part, a, b, c, false, share * part.world_area));
    }
}

/// True if all parts lie in one plane and scale, so that one map covers the texel.
bool share_one_map(const std::vector<Part>& parts, int x, int y)
{
    const std::array<glm::dvec2, 3> probes{glm::dvec2(x, y), glm::dvec2(x + 1, y),
                                           glm::dvec2(x, y + 1)};
    const Part& first = parts.front();
    if (first.triangle.collapsed)
        return false;
    std::array<glm::dvec3, 3> expected;
    for (int i = 0; i < 3; ++i)
        expected[i] = first.position(probes[i]);
    const double tolerance = kSameMap * std::min(glm::distance(expected[0], expected[1]),
                                                 glm::distance(expected[0], expected[2]));
    const glm::dvec3 normal = normal_at(first, first.polygon.centroid());
    return std::all_of(parts.begin() + 1, parts.end(), [&](const Part& part) {
        if (part.triangle.collapsed ||
            glm::dot(normal, normal_at(part, part.polygon.centroid())) < kCosSameNormal)
            return false;
        for (int i = 0; i < 3; ++i)
            if (glm::distance(part.position(probes[i]), expected[i]) > tolerance)
                return false;
        return true;
    });
}

/// Adds one parallelogram for all parts, if together they fill a rectangle of the texel.
bool merge(const std::vector<Part>& parts, int x, int y, std::vector<Piece>& pieces)
{
    if (!share_one_map(parts, x, y))
        return false;
    glm::dvec2 low(1e300), high(-1e300), centroid(0.0);
    double area = 0.0, world_area = 0.0;
    const Part* largest = &parts.front();
    for (const Part& part : parts) {
        low = glm::min(low, part.polygon.low());
        high = glm::max(high, part.polygon.high());
        area += part.polygon.area();
        centroid += part.polygon.area() * part.polygon.centroid();
        world_area += part.world_area;
        largest = part.world_area > largest->world_area ? &part : largest;
    }
    const glm::dvec2 middle = 0.5 * (low + high);
    const double rectangle = (high.x - low.x) * (high.y - low.y);
    if (std::abs(area - rectangle) > kSameShape * rectangle ||
        glm::distance(centroid / area, middle) > kSameShape)
        return false;
    pieces.push_back(make_piece(*largest, low, {high.x, low.y}, {low.x, high.y}, true, world_area));
    return true;
}

/// The point of a triangle nearest to `point`.
glm::dvec3 nearest_on_triangle(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v,
                               const glm::dvec3& point)
{
    // Inside: the perpendicular foot.
    const glm::dvec3 at = point - origin;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double whole = uu * vv - uv * uv;
    if (whole > 0.0) {
        const double s = (vv * glm::dot(at, u) - uv * glm::dot(at, v)) / whole;
        const double t = (uu * glm::dot(at, v) - uv * glm::dot(at, u)) / whole;
        if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
            return origin + s * u + t * v;
    }
    // Outside: the nearest point is on an edge.
    glm::dvec3 best = origin;
    const std::array<glm::dvec3, 4> corner{origin, origin + u, origin + v, origin};
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 edge = corner[i + 1] - corner[i];
        const double along =
            glm::dot(point - corner[i], edge) / std::max(glm::dot(edge, edge), 1e-300);
        const glm::dvec3 candidate = corner[i] + std::clamp(along, 0.0, 1.0) * edge;
        if (glm::distance(candidate, point) < glm::distance(best, point))
            best = candidate;
    }
    return best;
}

}  // namespace

glm::dvec3 nearest_on(const std::vector<Piece>& pieces, const glm::dvec3& point)
{
    glm::dvec3 best = pieces.front().origin;
    const auto consider = [&](const glm::dvec3& candidate) {
        if (glm::distance(candidate, point) < glm::distance(best, point))
            best = candidate;
    };
    for (const Piece& piece : pieces) {
        const glm::dvec3 origin(piece.origin), u(piece.edge_u), v(piece.edge_v);
        consider(nearest_on_triangle(origin, u, v, point));
        if (piece.parallelogram != 0)
            consider(nearest_on_triangle(origin + u + v, -u, -v, point));
    }
    return best;
}

TexelTriangle::TexelTriangle(const Scene& scene, const Surface& surface, std::uint32_t triangle)
{
    const Instance& instance = scene.instances[surface.instance];
    const Primitive& primitive = scene.meshes[instance.mesh].primitives[surface.primitive];
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t vertex = surface.indices[3 * triangle + i];
        plane.corner[i] = surface.texcoord[vertex];
        source[i] = surface.source_vertex[vertex];
        corner[i] = primitive.positions[source[i]];
    }
    plane.count = 3;
    collapsed = plane.area() < kCollapsedArea;
    const glm::dvec3 doubled = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double length = glm::length(doubled);
    front = length > 0.0 ? doubled / length : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dmat3 to_world(instance.transform);
    world_area = 0.5 * glm::length(glm::cross(to_world * (corner[1] - corner[0]),
                                              to_world * (corner[2] - corner[0])));
}

glm::dvec3 TexelTriangle::weights(const glm::dvec2& texel) const
{
    const glm::dvec2 u = plane.corner[1] - plane.corner[0], v = plane.corner[2] - plane.corner[0];
    const glm::dvec2 at = texel - plane.corner[0];
    const double whole = cross(u, v);
    const double second = cross(at, v) / whole, third = cross(u, at) / whole;
    return {1.0 - second - third, second, third};
}

glm::dvec3 TexelTriangle::position(const glm::dvec2& texel) const
{
    const glm::dvec3 w = weights(texel);
    return corner[0] + w.y * (corner[1] - corner[0]) + w.z * (corner[2] - corner[0]);
}

glm::dvec3 Part::weights(const glm::dvec2& point) const
{
    return triangle.collapsed ? glm::dvec3(1.0 - point.x - point.y, point.x, point.y)
                              : triangle.weights(point);
}

glm::dvec3 Part::position(const glm::dvec2& point) const
{
    const glm::dvec3 w = weights(point);
    return triangle.corner[0] + w.y * (triangle.corner[1] - triangle.corner[0]) +
           w.z * (triangle.corner[2] - triangle.corner[0]);
}

Part make_part(const Scene& scene, const Surface& surface, std::uint32_t triangle, int x, int y)
{
    const Mesh& mesh = scene.meshes[scene.instances[surface.instance].mesh];
    const Primitive& primitive = mesh.primitives[surface.primitive];
    Part part{TexelTriangle(scene, surface, triangle), &surface, &primitive,
              &scene.materials[primitive.material],    {},       0.0};
    if (part.triangle.collapsed) {
        part.polygon = Polygon({0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0});
        part.world_area = part.triangle.world_area;
        return part;
    }
    part.polygon = clip_to_slab(clip_to_slab(part.triangle.plane, 1, y, y + 1), 0, x, x + 1);
    part.world_area = part.triangle.world_area * part.polygon.area() / part.triangle.plane.area();
    return part;
}

glm::dvec3 normal_at(const Part& part, const glm::dvec2& point)
{
    const std::vector<glm::vec3>& normals = part.primitive->normals;
    if (normals.empty())
        return part.triangle.front;
    const glm::dvec3 w = part.weights(point);
    const auto& source = part.triangle.source;
    const glm::dvec3 sum = w.x * glm::dvec3(normals[source[0]]) +
                           w.y * glm::dvec3(normals[source[1]]) +
                           w.z * glm::dvec3(normals[source[2]]);
    const double length = glm::length(sum);
    if (!(length > 0.0) || glm::dot(sum, part.triangle.front) < kCosNormal * length)
        return part.triangle.front;
    return sum / length;
}

std::vector<Piece> cut_into_pieces(const std::vector<Part>& parts, int x, int y)
{
    std::vector<Piece> pieces;
    if (!merge(parts, x, y, pieces))
        for (const Part& part : parts)
            cut(part, pieces);
    if (pieces.size() > kMaxPieces) {
        std::stable_sort(pieces.begin(), pieces.end(),
                         [](const Piece& a, const Piece& b) { return a.share > b.share; });
        pieces.resize(kMaxPieces);
    }
    double whole = 0.0, running = 0.0;
    for (const Piece& piece : pieces)
        whole += piece.share;
    for (Piece& piece : pieces) {
        running += piece.share;
        piece.share = float(running / whole);
    }
    if (!pieces.empty())
        pieces.back().share = 1.0f;
    return pieces;
}

}  // namespace lumel
