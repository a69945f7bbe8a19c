#include "scene/values/geometry_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lumel {
namespace {

/// Twice the smallest area that float coordinates resolve, relative to the squared longest edge.
constexpr double kSmallestRelativeArea = 1e-7;
/// Twice an area [mesh units²] whose square is a normal float.
constexpr double kSmallestArea = 1e-18;

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const double area = glm::length(glm::cross(b - a, c - a));
    const double longest =
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    return area > std::max(kSmallestArea, kSmallestRelativeArea * longest);
}

/// [V] area-weighted normals of the faces around each vertex.
std::vector<glm::dvec3> face_normals(const Primitive& primitive)
{
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const std::uint32_t* corners = &primitive.indices[i];
        const glm::dvec3 a = primitive.positions[corners[0]];
        const glm::dvec3 cross = glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                            glm::dvec3(primitive.positions[corners[2]]) - a);
        for (int k = 0; k < 3; ++k)
            sums[corners[k]] += cross;
    }
    return sums;
}

}  // namespace

std::size_t drop_zero_area(Primitive& primitive)
{
    auto& indices = primitive.indices;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(primitive.positions[indices[i + k]]);
        };
        if (!has_area(corner(0), corner(1), corner(2)))
            continue;
        std::copy_n(indices.begin() + std::ptrdiff_t(i), 3, indices.begin() + std::ptrdiff_t(kept));
        kept += 3;
    }
    const std::size_t dropped = (indices.size() - kept) / 3;
    indices.resize(kept);
    return dropped;
}

std::size_t repair_normals(Primitive& primitive)
{
    auto& normals = primitive.normals;
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double length = glm::length(glm::dvec3(normals[i]));
        if (std::isfinite(length) && length > 0.0)
            normals[i] = glm::vec3(glm::dvec3(normals[i]) / length);
        else
            broken.push_back(i);
    }
    if (broken.empty())
        return 0;
    if (broken.size() == normals.size()) {
        normals.clear();
        return broken.size();
    }
    const std::vector<glm::dvec3> sums = face_normals(primitive);
    for (const std::size_t i : broken) {
        const double length = glm::length(sums[i]);
        normals[i] = length > 0.0 ? glm::vec3(sums[i] / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    }
    return broken.size();
}

bool is_flat(const glm::dmat4& matrix)
{
    constexpr double kSmallestRelativeVolume = 1e-9;
    const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const double box = glm::length(x) * glm::length(y) * glm::length(z);
    return !(std::abs(glm::dot(x, glm::cross(y, z))) > kSmallestRelativeVolume * box);
}

Bounds bounds_of(const Mesh& mesh)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Bounds box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (const Primitive& primitive : mesh.primitives)
        for (const glm::vec3& position : primitive.positions) {
            box.low = glm::min(box.low, glm::dvec3(position));
            box.high = glm::max(box.high, glm::dvec3(position));
        }
    return mesh.primitives.empty() ? Bounds{} : box;
}

Bounds placed_box(const Bounds& box, const glm::dmat4& world)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Bounds placed{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 point((corner & 1 ? box.high : box.low).x,
                               (corner & 2 ? box.high : box.low).y,
                               (corner & 4 ? box.high : box.low).z, 1.0);
        const glm::dvec3 at(world * point);
        placed.low = glm::min(placed.low, at);
        placed.high = glm::max(placed.high, at);
    }
    return placed;
}

bool reaches_too_far(const Bounds& box, const glm::dmat4& world)
{
    const Bounds placed = placed_box(box, world);
    const glm::dvec3 reach = glm::max(glm::abs(placed.low), glm::abs(placed.high));
    return !(std::max({reach.x, reach.y, reach.z}) <= double(kLargestCoordinate));
}

}  // namespace lumel
