#include "nearfield/open_lumels.h"

#include <limits>

#include "core/parallel.h"
#include "nearfield/looks.h"
#include "nearfield/sequence.h"
#include "nearfield/world_lumels.h"

namespace lumel {
namespace {

/// A patch of a few lumels so has a hundred rays: openings of less than a percent of what it sees,
/// which may be missed, matter as little.
constexpr std::uint32_t kRays = 16;
constexpr std::size_t kLumelsPerTask = 256;

}  // namespace

std::vector<char> open_lumels(const Scene& scene, const RayScene& rays, const Lumels& lumels)
{
    const WorldLumels world(scene, rays, lumels);
    const auto meets_front = [&](std::uint32_t i, std::uint32_t ray) {
        const LumelPoint x = world.point_on(i, sobol_pair(ray, hash_two(i, 0)));
        const glm::vec3 way = direction_about(x.normal, sobol_pair(ray, hash_two(i, 1)));
        RayHit hit;
        if (!rays.closest(x.position + world[i].lift * x.normal, way, 0.0f,
                          std::numeric_limits<float>::max(), ray, hit))
            return false;
        return (hit.front || is_double_sided(scene, hit)) && hit.tint == glm::vec3(1.0f);
    };
    std::vector<char> open(lumels.lumels.size(), 0);
    parallel_for(open.size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::uint32_t ray = 0; ray < kRays && !open[i]; ++ray)
                open[i] = meets_front(std::uint32_t(i), ray) ? 0 : 1;
    });
    return open;
}

}  // namespace lumel
