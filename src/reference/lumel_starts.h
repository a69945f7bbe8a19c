#pragma once
// Where paths leave lumels.

#include <vector>

#include <glm/glm.hpp>

#include "atlas/atlas.h"
#include "atlas/sample_rule.h"
#include "reference/path_vertex.h"
#include "scene/scene.h"

namespace lumel {

/// Points on lumels, in the world.
class LumelStarts {
public:
    /// `lumels` must outlive this. `lift` [m]: how far starts are kept off their surface.
    LumelStarts(const Scene& scene, const Lumels& lumels, SampleRule rule, float lift);

    /// Steps onto a lumel. `at` in the unit square chooses where. White matte: what it reflects is
    /// the irradiance.
    PathVertex start(const Lumel& lumel, const glm::vec2& at) const;

private:
    const Lumels& lumels_;
    SampleRule rule_;
    float lift_;  ///< [m]
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

}  // namespace lumel
