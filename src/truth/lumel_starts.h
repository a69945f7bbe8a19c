#pragma once
// Origins of paths on lumels.

#include <vector>

#include <glm/glm.hpp>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Points on lumels, world space.
class LumelStarts {
public:
    /// `lumels` must outlive this. ray_offset: distance of origins from their surface [m].
    LumelStarts(const Scene& scene, const Lumels& lumels, SampleRule rule, float ray_offset);

    /// Path origin at point `at` of the unit square on a lumel, with a white diffuse BRDF: it
    /// reflects the irradiance.
    PathVertex start(const Lumel& lumel, const glm::vec2& at) const;

private:
    const Lumels& lumels_;
    SampleRule rule_;
    float ray_offset_;  ///< [m]
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

}  // namespace lumel
