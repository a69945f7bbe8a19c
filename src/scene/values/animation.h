#pragma once
// Animation of a scene, decoded from its file and checked.

#include <optional>
#include <string>
#include <vector>

#include "scene/values/node_place.h"
#include "scene/values/scene.h"

namespace lumel {

/// Interpolation between keys: glTF 2.0, appendix C.
enum class Interpolation { step, linear, cubic_spline };

/// A value over time, constant before the first key and after the last.
struct Track {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;  ///< [K] [s], ascending, K > 0
    /// [K], or with cubic_spline [3K]: slope before the key, value, slope after it. A rotation is
    /// (x, y, z, w) of a unit quaternion; missing components are 0.
    std::vector<glm::dvec4> values;
};

/// The value at a time [s].
glm::dvec4 value_at(const Track& track, double time);

/// The unit rotation at a time [s], interpolated along the shorter arc.
glm::dquat rotation_at(const Track& track, double time);

/// A node of the file, animated or not.
struct AnimatedNode {
    int parent = -1;  ///< index of a node, -1: none
    NodePlace rest;   ///< without a matrix if it has tracks
    std::optional<Track> translation, rotation, scale;

    bool moves() const { return translation || rotation || scale; }
};

/// A material with animated emission: factor × strength [cd/m²].
struct AnimatedMaterial {
    int material = 0;  ///< index into Scene::materials
    glm::dvec3 rest_factor{0.0};
    double rest_strength = 1.0;
    std::optional<Track> factor, strength;
};

struct Animation {
    std::string name;
    double duration = 0.0;                    ///< time of the last key [s]
    std::vector<AnimatedNode> nodes;          ///< the file's
    std::vector<AnimatedMaterial> materials;  ///< those with animated emission
    std::vector<std::string> warnings;        ///< sentences for the user
};

/// Reads animations[index] of a glTF file: translation, rotation and scale of nodes, and by
/// KHR_animation_pointer emissiveFactor and emissiveStrength of materials. Throws Error{input} with
/// file, JSON pointer and reason if it is invalid or missing.
Animation read_animation(const std::string& path, std::size_t index = 0);

/// Node to world at a time [s].
glm::dmat4 transform_at(const Animation& animation, int node, double time);

/// Node to world relative to the scene's origin.
glm::mat4 place_in(const Scene& scene, const Animation& animation, int node, double time);

/// Emission of the material at a time [s], ≥ 0 [cd/m²].
glm::vec3 emitted_at(const AnimatedMaterial& material, double time);

/// Component-wise maximum of the emission over all keys [cd/m²].
glm::vec3 most_emitted(const AnimatedMaterial& material);

/// Instances of the scene that move, or have an animated ancestor, in order.
std::vector<std::uint32_t> movers_of(const Animation& animation, const Scene& scene);

/// Sets the scene, read from the same file, to a time [s]: transforms of moving instances and
/// cameras, and emission of materials.
void pose(Scene& scene, const Animation& animation, double time);

}  // namespace lumel
