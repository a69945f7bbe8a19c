#pragma once
// Surfaces of a scene for path tracing: material, normals and sides at a point.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "rays/paths/reflectance.h"
#include "scene/values/scene.h"

namespace lumel {

/// One primitive of one instance.
struct PlacedSurface {
    const Primitive* source = nullptr;
    const glm::mat4* transform = nullptr;  ///< mesh to world
    glm::mat3 normal_transform{1.0f};      ///< inverse transpose of the transform
    bool mirrored = false;
    bool double_sided = false;
    bool may_emit = false;
    bool uniform = false;  ///< same material everywhere: `look`
    MaterialSample look{};
};

/// Shading of a hit, on the side of the ray.
struct Shading {
    glm::vec3 geometric{0.0f};  ///< unit normal of the triangle, world
    glm::vec3 normal{0.0f};     ///< interpolated, unit, world; never behind the triangle
    Reflectance reflectance;
    glm::vec3 luminance{0.0f};  ///< emitted [cd/m²]
};

class Surfaces {
public:
    /// The scene must outlive this and not move.
    explicit Surfaces(const Scene& scene);

    /// Index of a primitive of an instance in `all()`.
    std::size_t index(std::uint32_t instance, std::uint32_t primitive) const
    {
        return first_[instance] + primitive;
    }
    /// Instance of a surface.
    std::uint32_t instance(std::size_t surface) const
    {
        const auto next = std::upper_bound(first_.begin(), first_.end(), surface);
        return std::uint32_t(next - first_.begin()) - 1;
    }
    /// In order of instance, then primitive.
    const std::vector<PlacedSurface>& all() const { return surfaces_; }

    /// Material of a surface at a point of one of its triangles.
    MaterialSample look_at(const PlacedSurface& surface, std::uint32_t triangle,
                           const glm::vec2& barycentric) const
    {
        return surface.uniform ? surface.look : textured_look(surface, triangle, barycentric);
    }

    /// Shading at a hit. The back of a single-sided surface is black and does not emit.
    Shading shade(const RayHit& hit) const;

private:
    Reflectance reflectance(const MaterialSample& look) const;
    MaterialSample textured_look(const PlacedSurface& surface, std::uint32_t triangle,
                                 const glm::vec2& barycentric) const;

    const Scene* scene_;
    std::vector<std::size_t> first_;  ///< [instances] index of the instance's first surface
    std::vector<PlacedSurface> surfaces_;
};

}  // namespace lumel
