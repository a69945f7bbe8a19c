#include "viewer/session/things.h"

#include <algorithm>
#include <limits>

#include "jobs/play/links_light.h"

namespace lumel {
namespace {

/// Maximum diagonal of a movable object's bounds, relative to the scene: walls of rooms are larger.
constexpr float kSmall = 0.5f;
constexpr std::size_t kMaxThings = 64;  ///< each ray tests the bounds of all

struct Sized {
    std::uint32_t instance;
    float diagonal;
};

/// All instances with triangles, and the diagonal of the scene.
std::pair<std::vector<Sized>, float> sizes(const Scene& scene)
{
    constexpr float kFarthest = std::numeric_limits<float>::max();
    std::vector<Sized> all;
    glm::vec3 low(kFarthest), high(-kFarthest);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const auto [from, to] = bounds_of(scene, i);
        if (!(from.x <= to.x))
            continue;
        all.push_back({i, glm::distance(from, to)});
        low = glm::min(low, from);
        high = glm::max(high, to);
    }
    return {std::move(all), all.empty() ? 0.0f : glm::distance(low, high)};
}

std::vector<std::uint32_t> small_ones(const Scene& scene)
{
    auto [all, diagonal] = sizes(scene);
    const float most = kSmall * diagonal;
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const Sized& one) { return one.diagonal > most; }),
              all.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const Sized& a, const Sized& b) { return a.diagonal > b.diagonal; });
    all.resize(std::min(all.size(), kMaxThings));
    std::vector<std::uint32_t> instances;
    for (const Sized& one : all)
        instances.push_back(one.instance);
    std::sort(instances.begin(), instances.end());
    return instances;
}

std::vector<std::uint32_t> named_ones(const Scene& scene, const std::vector<std::string>& names)
{
    std::vector<std::uint32_t> instances;
    for (const std::string& name : names) {
        find_instance(scene, name);  // throws if there is none
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].name == name)
                instances.push_back(i);
    }
    std::sort(instances.begin(), instances.end());
    instances.erase(std::unique(instances.begin(), instances.end()), instances.end());
    return instances;
}

}  // namespace

std::pair<glm::vec3, glm::vec3> bounds_of(const Scene& scene, std::uint32_t instance)
{
    constexpr float kFarthest = std::numeric_limits<float>::max();
    glm::vec3 low(kFarthest), high(-kFarthest);
    const Instance& one = scene.instances[instance];
    for (const Primitive& primitive : scene.meshes[std::size_t(one.mesh)].primitives)
        for (const std::uint32_t vertex : primitive.indices) {
            const glm::vec3 place(one.transform * glm::vec4(primitive.positions[vertex], 1.0f));
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    return {low, high};
}

std::vector<MovableObject> find_things(const Scene& scene, const Animation& animation,
                                       const std::vector<std::string>& movable)
{
    std::vector<MovableObject> things;
    std::vector<char> taken(scene.instances.size(), 0);
    const auto add = [&](const std::vector<std::uint32_t>& instances, bool played) {
        things.push_back({.name = scene.instances[instances.front()].name,
                          .instances = instances,
                          .played = played});
        for (const std::uint32_t instance : instances)
            taken[instance] = 1;
    };
    if (!animation.nodes.empty())
        for (const std::vector<std::uint32_t>& group : moving_together(scene, animation))
            add(group, true);
    for (const std::uint32_t instance :
         movable.empty() ? small_ones(scene) : named_ones(scene, movable))
        if (!taken[instance])
            add({instance}, false);
    return things;
}

}  // namespace lumel
