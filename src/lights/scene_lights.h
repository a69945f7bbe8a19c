#pragma once
// The lights of a scene, dimmed, coloured, moved and turned in the scene itself.

#include <string>
#include <vector>

#include "lights/light_sources.h"
#include "lights/light_state.h"

namespace lumel {

class SceneLights {
public:
    /// The scene must outlive this, and its materials, lights and sky are left to it.
    SceneLights(Scene& scene, const Lumels& lumels);

    std::vector<std::string> names() const { return names_.names(); }

    /// Throws Error{input} as set() would.
    void check(const LightState& state) const;
    /// Lights, sky and emission are those that were given, by the factors and at the places of the
    /// state, whatever was set before. Throws Error{input} for names that there are not, places
    /// where a light cannot be, and factors for a part of what one material makes shine.
    void set(const LightState& state);

private:
    /// The parts of a scene that send light.
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
