#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "api/scene.h"
#include "jobs/solve/setting.h"
#include "lumel/lumel.h"
#include "methods/matrix/relightable.h"
#include "methods/methods.h"

namespace lumel::v0 {

/// The prepared scene of a bake, with its light.
struct BakedSolution {
    /// Prepares the scene. device: null if there is none.
    BakedSolution(lumel::Scene scene, std::shared_ptr<const GltfDocument> file,
                  const gpu::Device* device, const BakeOptions& options, Stages& stages)
        : setting(std::move(scene), device, options, stages),
          document(std::move(file)),
          seed(seed_of(options.solver.method)),
          parts(options.parts)
    {
    }

    Setting setting;
    std::shared_ptr<const GltfDocument> document;  ///< see SceneImpl
    std::uint32_t seed;
    lumel::Parts parts;
    std::vector<glm::vec3> irradiance;        ///< [N] [lx]
    std::optional<lumel::Relightable> light;  ///< by source
};

}  // namespace lumel::v0
