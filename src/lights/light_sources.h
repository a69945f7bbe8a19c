#pragma once
// What of a scene's light can be dimmed and coloured by itself.

#include <cstdint>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel {

/// Shining instances beyond this number are taken together by their materials: each source costs a
/// solve and a map of direct light.
inline constexpr std::size_t kMaxEmitters = 64;

inline constexpr const char* kSkyName = "sky";

/// All of one name: the sky, lamps that are no surfaces, shining instances.
struct LightSource {
    std::string name;
    bool sky = false;
    std::vector<std::uint32_t> lights;     ///< indices into Scene::lights
    std::vector<std::uint32_t> instances;  ///< indices into Scene::instances
    std::vector<std::string> materials;    ///< that make the instances shine: further names
};

/// The sky first, then the lamps, then the instances of which a lumel shines, as the scene has
/// them. Lamps that give no light are left out.
std::vector<LightSource> light_sources(const Scene& scene, const Lumels& lumels);

/// A scene of the source's sky and lamps alone, without geometry; what direct_light() takes.
Scene lamps_of(const Scene& scene, const LightSource& source);

/// The scene with no other light than what the source's instances send. Instances, primitives and
/// triangles keep their numbers.
Scene only_shining(Scene scene, const LightSource& source);

}  // namespace lumel
