#include "bench/settings.h"

#include <algorithm>
#include <numbers>

#include "base/core/error.h"

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

/// A closed grey box.
void add_box(Scene& scene, const glm::vec3& centre, const glm::vec3& size)
{
    Material material{.name = "box"};
    material.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    scene.materials.push_back(material);

    Primitive box;
    for (int side = 0; side < 6; ++side) {
        glm::vec3 out(0.0f), u(0.0f);
        out[side / 2] = side % 2 == 0 ? 0.5f : -0.5f;
        u[(side / 2 + 1) % 3] = 0.5f;
        const glm::vec3 v = 2.0f * glm::cross(out, u);
        const auto first = std::uint32_t(box.positions.size());
        for (const glm::vec3& corner : {out - u - v, out + u - v, out + u + v, out - u + v})
            box.positions.push_back(size * corner);
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
            box.indices.push_back(first + k);
    }
    box.material = int(scene.materials.size()) - 1;
    scene.meshes.push_back({"box", {box}});

    Instance instance{.name = "box", .mesh = int(scene.meshes.size()) - 1};
    instance.transform[3] = glm::vec4(centre, 1.0f);
    scene.instances.push_back(instance);
}

bool is_competitor(std::string_view racer)
{
    return racer == kPathTracer || racer == kIteratedGather;
}

bool reads(std::string_view racer, std::string_view option)
{
    return is_competitor(racer) ? option == "seed" || option == "sampling"
                                : method_of(racer).option(option) != nullptr;
}

}  // namespace

Settings settings_of(const Settings& settings, std::string_view method)
{
    Settings own = settings;
    own.given.id = method;
    const MethodInfo& info = method_of(method);
    std::erase_if(own.given.values, [&](const auto& given) { return !info.option(given.first); });
    own.given.options();
    return own;
}

std::string first_method(const Settings& settings)
{
    const auto first = std::find_if(settings.racers.begin(), settings.racers.end(),
                                    [](const std::string& name) { return !is_competitor(name); });
    return first == settings.racers.end() ? methods().front().id : *first;
}

void check_racers(const Settings& settings)
{
    const MaterialModel materials = method_of(first_method(settings)).materials;
    const auto refuse = [](const std::string& where, const std::string& what) {
        throw Error(ErrorKind::input, where, what);
    };
    for (const std::string& name : settings.racers) {
        if (!is_competitor(name))
            settings_of(settings, name);
        const bool fits = name == kPathTracer ||
                          (name == kIteratedGather ? materials == MaterialModel::diffuse
                                                   : method_of(name).materials == materials);
        if (!fits)
            refuse("--solver " + name, "takes other materials than " + first_method(settings) +
                                           "; let them race apart");
    }
    for (const auto& given : settings.given.values)
        if (std::none_of(settings.racers.begin(), settings.racers.end(),
                         [&](const std::string& name) { return reads(name, given.first); }))
            refuse("--" + given.first, "is read by none of those that race");
}

Scene scene_of(const Settings& settings)
{
    Scene scene =
        read_scene(settings.scene, method_of(settings.given.id).materials, settings.lights);
    if (const std::vector<float>& l = settings.lamp; !l.empty())
        add_lamp(scene, {{l[0], l[1], l[2]}, {l[3], l[4]}, l[5]});
    if (const std::vector<float>& b = settings.box; !b.empty())
        add_box(scene, {b[0], b[1], b[2]}, {b[3], b[4], b[5]});
    return scene;
}

SolveScene prepare(const Settings& settings, int size)
{
    return SolveScene(scene_of(settings), AtlasOptions{.size = size});
}

}  // namespace lumel::bench
