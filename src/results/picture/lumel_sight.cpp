#include "results/picture/lumel_sight.h"

#include <limits>

#include "results/picture/lit_scene.h"

namespace lumel {
namespace {

glm::vec3 toward_eye(const View& view, const glm::vec3& from)
{
    return view.orthographic_height > 0.0f ? glm::normalize(glm::vec3(view.transform[2]))
                                           : glm::normalize(glm::vec3(view.transform[3]) - from);
}

/// Unit normal of the piece nearest to the lumel's centre.
glm::vec3 facing_of(const WorldLumels& world, const WorldLumel& lumel)
{
    glm::vec3 normal = lumel.normal;
    float least = std::numeric_limits<float>::max();
    for (const Facet* facet = world.begin(lumel); facet != world.end(lumel); ++facet) {
        const glm::vec3 across =
            glm::cross(facet->corner[1] - facet->corner[0], facet->corner[2] - facet->corner[0]);
        glm::vec3 middle(0.0f);
        for (int c = 0; c < facet->count; ++c)
            middle += facet->corner[c] / float(facet->count);
        const glm::vec3 off = middle - lumel.centre;
        if (const float squared = glm::dot(off, off);
            squared < least && across != glm::vec3(0.0f)) {
            least = squared;
            normal = glm::normalize(across);
        }
    }
    return normal;
}

}  // namespace

LumelSight see_lumels(const View& view, const WorldLumels& world, const Lumels& lumels)
{
    LumelSight sight;
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i) {
        const Gloss& gloss = lumels.gloss[i];
        if ((lumels.lumels[i].flags & kLumelBuried) != 0 || gloss.specular == glm::vec3(0.0f))
            continue;
        const WorldLumel& lumel = world[i];
        const glm::vec3 toward = toward_eye(view, lumel.centre);
        if (!(glm::dot(lumel.normal, toward) > 0.0f))
            continue;
        sight.points.push_back({lumel.centre, lumel.normal, facing_of(world, lumel), toward,
                                gloss.specular, gloss.shininess});
        sight.lumels.push_back(i);
    }
    return sight;
}

std::vector<glm::vec3> by_lumel(const LumelSight& sight, std::span<const glm::vec3> radiance,
                                std::size_t lumel_count)
{
    std::vector<glm::vec3> values(lumel_count, glm::vec3(0.0f));
    for (std::size_t p = 0; p < radiance.size(); ++p)
        values[sight.lumels[p]] = radiance[p];
    return values;
}

std::vector<glm::vec3> look_up(const Seen& seen, const SolveScene& scene, const Image& front,
                               const Image& back)
{
    const LitScene texture(scene, front, back);
    std::vector<glm::vec3> radiance;
    radiance.reserve(seen.glossy.size());
    for (const std::uint32_t point : seen.index) {
        const RayHit& hit = seen.points[point].hit;
        radiance.push_back(hit.tint * texture.irradiance(hit));
    }
    return radiance;
}

}  // namespace lumel
