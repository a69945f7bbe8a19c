#pragma once
// Dims, colours, moves and rotates the lights of a scene by changing the scene itself.

#include <string>
#include <vector>

#include "lights/light_sources.h"
#include "lights/light_state.h"

namespace lumel {

class SceneLights {
public:
    /// The scene must outlive this, which owns its materials, lights and sky.
    SceneLights(Scene& scene, const Lumels& lumels);

    std::vector<std::string> names() const { return names_.names(); }

    /// Throws Error{input} as set() does.
    void check(const LightState& state) const;
    /// Sets lights, sky and emission to their initial values, modified by the factors and
    /// positions of the state. Throws Error{input} for unknown names, invalid positions, and
    /// factors for a part of the surfaces of an emissive material.
    void set(const LightState& state);

private:
    /// Emitting parts of a scene.
    struct Lights {
        std::vector<PunctualLight> lamps;
        Sky sky;
        std::vector<glm::vec3> emitted;  ///< [materials]
    };

    Lights under(const LightState& state) const;
    void move(Lights& lights, std::size_t source, const LampPlace& place) const;
    void dim_surfaces(Lights& lights, const std::vector<glm::vec3>& factors) const;

    Scene& scene_;
    const Lights given_;
    std::vector<LightSource> sources_;
    SourceNames names_;
};

}  // namespace lumel
