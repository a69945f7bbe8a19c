#include "nearfield/buried.h"

#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "nearfield/sequence.h"
#include "nearfield/world_lumels.h"

namespace lumel {

namespace {

constexpr std::uint32_t kFirstPoints = 12;  ///< per lumel; if all are open, so is the lumel
constexpr std::uint32_t kPoints = 128;      ///< per lumel that is partly hidden
constexpr std::uint32_t kDirections = 16;   ///< per point
/// A lumel with less than this left open counts as buried: too little is seen of it to hold a value
/// of its own, and its neighbours' light fills it better.
constexpr float kMostHidden = 0.875f;
/// A surface closer than this above a lumel, in the lumel's sizes, lies on it.
constexpr float kContact = 0.01f;
/// Blended surfaces are judged by one draw; which one does not matter.
constexpr std::uint32_t kBlendSeed = 0;

/// Cosine-distributed direction about unit normal n, for (s, t) in the unit square.
glm::vec3 direction_about(const glm::vec3& n, const glm::vec2& st)
{
    const glm::vec3 side = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(side, n));
    const glm::vec3 v = glm::cross(n, u);
    const float radius = std::sqrt(st.x);
    const float angle = 2.0f * std::numbers::pi_v<float> * st.y;
    const glm::vec3 flat = radius * (std::cos(angle) * u + std::sin(angle) * v);
    return glm::normalize(flat + std::sqrt(std::max(0.0f, 1.0f - st.x)) * n);
}

bool is_double_sided(const Scene& scene, const RayHit& hit)
{
    const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
    return scene.materials[mesh.primitives[hit.primitive].material].double_sided;
}

bool is_shut_in(const Scene& scene, const RayScene& rays, const WorldLumel& lumel,
                const LumelPoint& point, const glm::vec3& direction)
{
    RayHit hit;
    const glm::vec3 origin = point.position + lumel.lift * point.normal;
    if (!rays.closest(origin, direction, 0.0f, INFINITY, kBlendSeed, hit))
        return false;
    if (!hit.front && !is_double_sided(scene, hit))
        return true;
    return hit.distance * glm::dot(direction, point.normal) < kContact * lumel.size;
}

bool is_hidden(const Scene& scene, const RayScene& rays, const WorldLumels& world, std::size_t i,
               std::uint32_t k)
{
    const LumelPoint point = world.point_on(i, sobol_pair(k, 0));
    for (std::uint32_t d = 0; d < kDirections; ++d) {
        const glm::vec2 st = sobol_pair(d, hash_two(k, 1));
        if (!is_shut_in(scene, rays, world[i], point, direction_about(point.normal, st)))
            return false;
    }
    return true;
}

/// Share of the lumel's area that is hidden.
float hidden_share(const Scene& scene, const RayScene& rays, const WorldLumels& world,
                   std::size_t i)
{
    std::uint32_t hidden = 0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        hidden += is_hidden(scene, rays, world, i, k);
        if (k + 1 == kFirstPoints && hidden == 0)
            return 0.0f;
    }
    return float(hidden) / float(kPoints);
}

}  // namespace

void mark_buried(const Scene& scene, const RayScene& rays, Lumels& lumels)
{
    const WorldLumels world(scene, rays, lumels);
    parallel_for(world.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            lumels.lumels[i].hidden = hidden_share(scene, rays, world, i);
            if (lumels.lumels[i].hidden > kMostHidden)
                lumels.lumels[i].flags |= kLumelBuried;
        }
    });
}

}  // namespace lumel
