#pragma once
// Origins of paths on lumels.

#include <vector>

#include <glm/glm.hpp>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Points on lumels, world space.
class LumelStarts {
public:
    /// `lumels` must outlive this. rays: of the scene.
    LumelStarts(const Scene& scene, const RayScene& rays, const Lumels& lumels, SampleRule rule);

    /// Path origin at point `at` of the unit square on lumel i, with a white diffuse BRDF: it
    /// reflects the irradiance.
    PathVertex start(std::size_t i, const glm::vec2& at) const;

private:
    const Lumels& lumels_;
    SampleRule rule_;
    float ray_offset_;  ///< [m] for lumels of unknown triangles
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

}  // namespace lumel
