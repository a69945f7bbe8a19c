#include "truth/emitters.h"

#include <algorithm>

#include "base/core/luminance.h"

namespace lumel {

namespace {

/// Sample points per axis for the mean emission of a textured triangle.
constexpr int kMeanSide = 6;

/// Maps the unit square to a triangle's u, v with little distortion, preserving areas.
/// [Hei19] E. Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
glm::vec2 square_to_triangle(glm::vec2 at)
{
    if (at.y > at.x) {
        at.x *= 0.5f;
        at.y -= at.x;
    } else {
        at.y *= 0.5f;
        at.x -= at.y;
    }
    return at;
}

float luminance_of(const MaterialSample& look)
{
    return look.opacity * float(luminance(look.emitted));
}

float mean_luminance(const Surfaces& surfaces, const PlacedSurface& surface, std::uint32_t triangle)
{
    if (surface.uniform)
        return luminance_of(surface.look);
    float sum = 0.0f;
    for (int y = 0; y < kMeanSide; ++y)
        for (int x = 0; x < kMeanSide; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(kMeanSide);
            sum += luminance_of(surfaces.look_at(surface, triangle, square_to_triangle(at)));
        }
    return sum / float(kMeanSide * kMeanSide);
}

}  // namespace

Emitters::Emitters(const Surfaces& surfaces)
    : surfaces_(&surfaces),
      densities_(surfaces.all().size())
{
    std::vector<double> powers;
    for (std::size_t surface = 0; surface < surfaces.all().size(); ++surface)
        add(surface, powers);

    double total = 0.0;
    for (const double power : powers)
        running_.push_back(total += power);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Triangle& emitter = triangles_[i];
        running_[i] /= total;
        const double area = 0.5 * glm::length(glm::cross(emitter.edge_u, emitter.edge_v));
        emitter.density = float(powers[i] / total / area);
        std::vector<float>& densities = densities_[emitter.surface];
        densities.resize(surfaces.all()[emitter.surface].source->indices.size() / 3);
        densities[emitter.triangle] = emitter.density;
    }
}

/// Lists the emissive triangles of a surface with their relative powers.
void Emitters::add(std::size_t surface_index, std::vector<double>& powers)
{
    const PlacedSurface& surface = surfaces_->all()[surface_index];
    if (surface.uniform && luminance_of(surface.look) <= 0.0f)
        return;
    const Primitive& source = *surface.source;
    for (std::uint32_t t = 0; t < source.indices.size() / 3; ++t) {
        const auto corner = [&](std::uint32_t k) {
            const glm::vec3& position = source.positions[source.indices[3 * std::size_t(t) + k]];
            return glm::vec3(*surface.transform * glm::vec4(position, 1.0f));
        };
        Triangle emitter;
        emitter.surface = surface_index;
        emitter.triangle = t;
        emitter.corner = corner(0);
        emitter.edge_u = corner(1) - emitter.corner;
        emitter.edge_v = corner(2) - emitter.corner;
        emitter.reach = longest_edge(corner(0), corner(1), corner(2));
        for (std::uint32_t k = 0; k < 3; ++k)
            emitter.reach = std::max(emitter.reach, largest_coordinate(corner(k)));
        const glm::vec3 across = glm::cross(emitter.edge_u, emitter.edge_v);
        const float twice_area = glm::length(across);
        const float mean = mean_luminance(*surfaces_, surface, t);
        if (!(twice_area > 0.0f) || !(mean > 0.0f))
            continue;
        emitter.normal = (surface.mirrored ? -1.0f : 1.0f) * across / twice_area;
        triangles_.push_back(emitter);
        powers.push_back(double(mean) * twice_area * (surface.double_sided ? 2.0 : 1.0));
    }
}

EmitterPoint Emitters::sample(const glm::vec2& at) const
{
    // Selects a triangle by power, and rescales the number to 0…1.
    const auto found = std::upper_bound(running_.begin(), running_.end(), double(at.x));
    const std::size_t chosen =
        std::min(std::size_t(found - running_.begin()), triangles_.size() - 1);
    const double below = chosen > 0 ? running_[chosen - 1] : 0.0;
    const float rest = std::clamp(float((at.x - below) / (running_[chosen] - below)), 0.0f, 1.0f);

    const Triangle& emitter = triangles_[chosen];
    const PlacedSurface& surface = surfaces_->all()[emitter.surface];
    const glm::vec2 place = square_to_triangle({rest, at.y});
    const MaterialSample look = surfaces_->look_at(surface, emitter.triangle, place);
    EmitterPoint point;
    point.position = emitter.corner + place.x * emitter.edge_u + place.y * emitter.edge_v;
    point.normal = emitter.normal;
    point.luminance = look.emitted * look.opacity;
    point.density = emitter.density;
    point.double_sided = surface.double_sided;
    point.reach = emitter.reach;
    return point;
}

}  // namespace lumel
