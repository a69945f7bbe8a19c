// A surface of albedo ρ with direct light D and reflected light X sends
//
//     B = ρ (D + X)

#include "results/daylight/reflected_daylight.h"

#include "scene/sky/sky_patches.h"

namespace lumel {

ReflectedDaylight::ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                                     const CoefficientRays& rays, const ProgressCallback& progress)
    : count_(SkyPatches().count() + places.size()),
      sent_(lumel_coefficients(
          scene, places, rays,
          [&](std::size_t lumel, std::size_t, const glm::vec3& direct, const glm::vec3& reflected) {
              return scene.lumels.lumels[lumel].albedo * (direct + reflected);
          },
          progress))
{
}

}  // namespace lumel
