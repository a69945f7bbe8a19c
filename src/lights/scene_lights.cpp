#include "lights/scene_lights.h"

#include <optional>

#include <glm/trigonometric.hpp>

#include "base/core/error.h"
#include "base/json/json_view.h"
#include "scene/sky/sky_file.h"

namespace lumel {
namespace {

SourceNames names_of(const std::vector<LightSource>& sources)
{
    std::vector<SourceNames::Source> names;
    for (const LightSource& source : sources)
        names.push_back({source.name, source.materials});
    return SourceNames(std::move(names));
}

std::vector<glm::vec3> emitted_of(const Scene& scene)
{
    std::vector<glm::vec3> emitted;
    for (const Material& material : scene.materials)
        emitted.push_back(material.emitted);
    return emitted;
}

}  // namespace

SceneLights::SceneLights(Scene& scene, const Lumels& lumels)
    : scene_(scene),
      given_{scene.lights, scene.sky, emitted_of(scene)},
      sources_(light_sources(scene, lumels)),
      names_(names_of(sources_))
{
}

void SceneLights::check(const LightState& state) const
{
    under(state);
}

void SceneLights::set(const LightState& state)
{
    Lights lights = under(state);
    scene_.lights = std::move(lights.lamps);
    scene_.sky = std::move(lights.sky);
    for (std::size_t m = 0; m < lights.emitted.size(); ++m)
        scene_.materials[m].emitted = lights.emitted[m];
}

SceneLights::Lights SceneLights::under(const LightState& state) const
{
    Lights lights = given_;
    const std::vector<glm::vec3> factors = names_.factors(state);
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        for (const std::uint32_t l : sources_[s].lights)
            lights.lamps[l].color *= factors[s];
        if (sources_[s].sky)
            for (glm::vec3& radiance : lights.sky.radiance)
                radiance *= factors[s];
    }
    dim_surfaces(lights, factors);
    for (const auto& [name, place] : state.places)
        move(lights, names_.of(name).front(), place);
    return lights;
}

void SceneLights::move(Lights& lights, std::size_t s, const LampPlace& place) const
{
    const LightSource& source = sources_[s];
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorKind::input, "", lumel::quoted(source.name) + " " + what);
    };
    const bool is_sky = source.sky && source.lights.empty();
    if (is_sky && place.turn && !place.position && !place.direction) {
        lights.sky = turned(lights.sky, glm::radians(*place.turn));
        return;
    }
    if (source.lights.size() != 1)
        refuse(is_sky ? "is the sky, which has only a \"turn\""
               : source.lights.empty()
                   ? "is not a lamp: only point, spot and directional lights can be moved"
                   : "is the name of several lamps: give each a name of its "
                     "own to move it");
    PunctualLight& lamp = lights.lamps[source.lights.front()];
    lamp = placed(lamp, place, scene_.origin);
}

/// A material has one emission, so all its surfaces are dimmed together.
void SceneLights::dim_surfaces(Lights& lights, const std::vector<glm::vec3>& factors) const
{
    std::vector<std::optional<std::size_t>> source_of(lights.emitted.size());
    for (std::size_t s = 0; s < sources_.size(); ++s)
        for (const std::uint32_t i : sources_[s].instances)
            for (const Primitive& primitive :
                 scene_.meshes[std::size_t(scene_.instances[i].mesh)].primitives) {
                const auto m = std::size_t(primitive.material);
                if (given_.emitted[m] == glm::vec3(0.0f))
                    continue;
                if (source_of[m] && factors[*source_of[m]] != factors[s])
                    throw Error(ErrorKind::input, "",
                                lumel::quoted(sources_[*source_of[m]].name) + " and " +
                                    lumel::quoted(sources_[s].name) +
                                    " share the emissive material " +
                                    lumel::quoted(scene_.materials[m].name) +
                                    ": dim them alike, or give each a material of its own");
                source_of[m] = s;
                lights.emitted[m] = factors[s] * given_.emitted[m];
            }
}

}  // namespace lumel
