#include "lights/light_sources.h"

#include <algorithm>
#include <set>

namespace lumel {
namespace {

bool contains(const auto& list, const auto& value)
{
    return std::find(list.begin(), list.end(), value) != list.end();
}

std::string name_of(const Scene& scene, int material)
{
    const std::string& name = scene.materials[std::size_t(material)].name;
    return name.empty() ? "material " + std::to_string(material) : name;
}

std::string name_of(const Scene& scene, std::uint32_t instance)
{
    const std::string& name = scene.instances[instance].name;
    return name.empty() ? "instance " + std::to_string(instance) : name;
}

std::vector<std::string> shining_materials(const Scene& scene, std::uint32_t instance)
{
    std::vector<std::string> names;
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[instance].mesh)];
    for (const Primitive& primitive : mesh.primitives) {
        const std::string name = name_of(scene, primitive.material);
        const Material& material = scene.materials[std::size_t(primitive.material)];
        if (material.emitted != glm::vec3(0.0f) && !contains(names, name))
            names.push_back(name);
    }
    return names;
}

LightSource& named(std::vector<LightSource>& sources, const std::string& name)
{
    const auto found = std::find_if(sources.begin(), sources.end(),
                                    [&](const LightSource& source) { return source.name == name; });
    return found != sources.end() ? *found : sources.emplace_back(LightSource{.name = name});
}

}  // namespace

std::vector<std::uint32_t> shining_instances(const Lumels& lumels)
{
    std::set<std::uint32_t> shining;
    for (const Lumel& lumel : lumels.lumels)
        if (!(lumel.flags & kLumelBuried) && lumel.emission != glm::vec3(0.0f))
            shining.insert(lumel.instance);
    return {shining.begin(), shining.end()};
}

std::vector<LightSource> light_sources(const Scene& scene, const Lumels& lumels)
{
    return light_sources(scene, shining_instances(lumels));
}

std::vector<LightSource> light_sources(const Scene& scene,
                                       const std::vector<std::uint32_t>& instances)
{
    std::vector<LightSource> sources;
    if (!scene.sky.empty())
        sources.push_back({.name = kSkyName, .sky = true});
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
        if (shines(scene.lights[i]))
            named(sources, scene.lights[i].name).lights.push_back(i);

    for (const std::uint32_t i : instances) {
        const std::vector<std::string> materials = shining_materials(scene, i);
        const bool by_material = instances.size() > kMaxEmitters && !materials.empty();
        LightSource& source = named(sources, by_material ? materials.front() : name_of(scene, i));
        source.instances.push_back(i);
        for (const std::string& material : materials)
            if (!contains(source.materials, material))
                source.materials.push_back(material);
    }
    return sources;
}

Scene lamps_of(const Scene& scene, const LightSource& source)
{
    Scene lamps;
    lamps.path = scene.path;
    lamps.profiles = scene.profiles;
    if (source.sky)
        lamps.sky = scene.sky;
    for (const std::uint32_t i : source.lights)
        lamps.lights.push_back(scene.lights[i]);
    return lamps;
}

}  // namespace lumel
