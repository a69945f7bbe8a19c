#pragma once
// Light sources of a scene that can be dimmed and coloured separately.

#include <cstdint>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel {

/// Above this number, emissive instances are grouped by material: each source needs a solve and a
/// direct-light map.
inline constexpr std::size_t kMaxEmitters = 64;

inline constexpr const char* kSkyName = "sky";

/// All sources of one name: the sky, lamps, emissive instances.
struct LightSource {
    std::string name;
    bool sky = false;
    std::vector<std::uint32_t> lights;     ///< indices into Scene::lights
    std::vector<std::uint32_t> instances;  ///< indices into Scene::instances
    std::vector<std::string> materials;    ///< emissive materials of the instances: further names
};

/// The sky, the lamps, then instances with an emissive lumel, in scene order. Omits lamps without
/// light.
std::vector<LightSource> light_sources(const Scene& scene, const Lumels& lumels);
/// As above, with these emissive instances, in scene order.
std::vector<LightSource> light_sources(const Scene& scene,
                                       const std::vector<std::uint32_t>& instances);

/// Instances with an emissive lumel that is open, in scene order.
std::vector<std::uint32_t> shining_instances(const Lumels& lumels);

/// A scene with only the source's sky and lamps, without geometry; input of direct_light().
Scene lamps_of(const Scene& scene, const LightSource& source);

}  // namespace lumel
