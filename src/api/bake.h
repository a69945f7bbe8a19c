#pragma once

#include <optional>
#include <vector>

#include "api/scene.h"
#include "jobs/solve/setting.h"
#include "lumel/lumel.h"
#include "methods/matrix/relightable.h"
#include "methods/methods.h"

namespace lumel::v0 {

/// What a bake leaves for later: the scene made ready, and its light.
struct BakedSolution {
    /// Makes the scene ready. device: null if there is none.
    BakedSolution(const SceneImpl& scene, const gpu::Device* device, const BakeOptions& options,
                  Stages& stages)
        : setting(scene.scene, device, options, stages),
          is_of_file(scene.is_of_file),
          seed(seed_of(options.solver.method)),
          parts(options.parts)
    {
    }

    Setting setting;
    bool is_of_file;  ///< the scene was read from a file
    std::uint32_t seed;
    lumel::Parts parts;
    std::vector<glm::vec3> irradiance;        ///< [N] [lx]
    std::optional<lumel::Relightable> light;  ///< by source
};

}  // namespace lumel::v0
