#pragma once
// Where the light of a lumel comes from.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

struct SenderOptions {
    std::uint32_t rays = 16384;  ///< from the lumel, by the cosine
    std::uint32_t seed = 1;
    float cells =
        8.0f;  ///< cells along the diagonal in which senders of a surface are distinguished
};

/// A part of a surface, the sky, or a lamp that is no surface.
struct Contributor {
    enum class Kind { surface, sky, lamp } kind = Kind::surface;
    std::uint32_t index = 0;  ///< into Scene::instances, or Scene::lights
    int material = -1;        ///< of a surface: what most of its light comes from
    glm::vec3 place{0.0f};    ///< mean, in the world [m]; of a surface or a lamp that has one
    float distance = 0.0f;    ///< mean [m]
    glm::vec3 light{0.0f};    ///< that arrives at the lumel [lx]
};

struct Senders {
    std::vector<Contributor> list;  ///< the one of most light first, by luminance
    std::vector<float> density;     ///< [N] luminance of a lumel's sender, per area of it [lx/m²]
    glm::vec3 light{0.0f};          ///< of all [lx]
};

/// Follows rays from a lumel: what they meet sends E + ρH, with H [N] [lx]; lamps are sampled
/// apart. Light solved with gloss counts as if it were diffuse.
Senders find_senders(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                     const Lumels& lumels, std::span<const glm::vec3> irradiance,
                     std::uint32_t lumel, const SenderOptions& options);

}  // namespace lumel
