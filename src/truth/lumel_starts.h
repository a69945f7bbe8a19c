#pragma once
// Where paths leave lumels.

#include <vector>

#include <glm/glm.hpp>

#include "atlas/lumels/sample_rule.h"
#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Points on lumels, in the world.
class LumelStarts {
public:
    /// `lumels` must outlive this. `ray_offset` [m]: how far starts are kept off their surface.
    LumelStarts(const Scene& scene, const Lumels& lumels, SampleRule rule, float ray_offset);

    /// Steps onto a lumel. `at` in the unit square chooses where. White matte: what it reflects is
    /// the irradiance.
    PathVertex start(const Lumel& lumel, const glm::vec2& at) const;

private:
    const Lumels& lumels_;
    SampleRule rule_;
    float ray_offset_;  ///< [m]
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

}  // namespace lumel
