#include "bench/settings.h"

#include <numbers>

namespace lumel::bench {
namespace {

void add_lamp(Scene& scene, const Lamp& lamp)
{
    Material material{.name = "lamp"};
    material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    material.emitted = glm::vec3(lamp.exitance / std::numbers::pi_v<float>);
    scene.materials.push_back(material);

    const glm::vec3 x(0.5f * lamp.size.x, 0.0f, 0.0f), z(0.0f, 0.0f, 0.5f * lamp.size.y);
    Primitive quad;
    quad.positions = {-x - z, x - z, x + z, -x + z};
    quad.indices = {0, 1, 2, 0, 2, 3};
    quad.material = int(scene.materials.size()) - 1;
    scene.meshes.push_back({"lamp", {quad}});

    Instance instance{.name = "lamp", .mesh = int(scene.meshes.size()) - 1};
    instance.transform[3] = glm::vec4(lamp.centre, 1.0f);
    scene.instances.push_back(instance);
}

}  // namespace

Prepared prepare(const Settings& settings, int size)
{
    Scene scene =
        read_scene(settings.scene, method_of(settings.given.id).materials, settings.lights);
    if (const std::vector<float>& l = settings.lamp; !l.empty())
        add_lamp(scene, {{l[0], l[1], l[2]}, {l[3], l[4]}, l[5]});
    return Prepared(std::move(scene), AtlasOptions{.size = size});
}

}  // namespace lumel::bench
