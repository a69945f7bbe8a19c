#pragma once
// How a scene changes with time: the contents of its file, decoded and checked.

#include <optional>
#include <string>
#include <vector>

#include "scene/values/node_place.h"
#include "scene/values/scene.h"

namespace lumel {

/// What is between two keys: glTF 2.0, appendix C.
enum class Interpolation { step, linear, cubic_spline };

/// A value over time. Before the first key it is that of the first, after the last that of the
/// last.
struct Track {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;  ///< [K] [s], rising, K > 0
    /// [K]; with cubic_spline [3K]: slope before the key, value, slope after it. A rotation is
    /// (x, y, z, w) of a unit quaternion; what has fewer components leaves the rest 0.
    std::vector<glm::dvec4> values;
};

/// The value at a time [s].
glm::dvec4 value_at(const Track& track, double time);

/// The same for rotations, along the shorter arc; of unit length.
glm::dquat rotation_at(const Track& track, double time);

/// A node of the file, whether it moves or not.
struct AnimatedNode {
    int parent = -1;  ///< index of a node, -1: none
    NodePlace rest;   ///< without a matrix if it has tracks
    std::optional<Track> translation, rotation, scale;

    bool moves() const { return translation || rotation || scale; }
};

/// A material whose emission changes: factor × strength [cd/m²].
struct AnimatedMaterial {
    int material = 0;  ///< index into Scene::materials
    glm::dvec3 rest_factor{0.0};
    double rest_strength = 1.0;
    std::optional<Track> factor, strength;
};

struct Animation {
    std::string name;
    double duration = 0.0;                    ///< to the last key [s]
    std::vector<AnimatedNode> nodes;          ///< the file's
    std::vector<AnimatedMaterial> materials;  ///< those whose emission changes
    std::vector<std::string> warnings;        ///< sentences for the user
};

/// Reads animations[index] of a glTF file: translation, rotation and scale of nodes, and by
/// KHR_animation_pointer emissiveFactor and emissiveStrength of materials.
/// Throws Error{input} with file, JSON pointer and reason for anything invalid, and if there is no
/// such animation.
Animation read_animation(const std::string& path, std::size_t index = 0);

/// Node to world at a time [s].
glm::dmat4 transform_at(const Animation& animation, int node, double time);

/// The same from the scene's origin.
glm::mat4 place_in(const Scene& scene, const Animation& animation, int node, double time);

/// What the material emits at a time [s], never below 0 [cd/m²].
glm::vec3 emitted_at(const AnimatedMaterial& material, double time);

/// No key emits more than this, component by component [cd/m²].
glm::vec3 most_emitted(const AnimatedMaterial& material);

/// Instances of the scene that move, or are below a node that does, in order.
std::vector<std::uint32_t> movers_of(const Animation& animation, const Scene& scene);

/// Puts the scene, read from the same file, into the state of a time [s]: instances and cameras
/// that move, and what materials emit.
void pose(Scene& scene, const Animation& animation, double time);

}  // namespace lumel
