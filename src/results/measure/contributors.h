#pragma once
// Contributors to the light of a lumel.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

struct SenderOptions {
    std::uint32_t rays = 16384;  ///< from the lumel, cosine-distributed
    std::uint32_t seed = 1;
    float cells = 8.0f;  ///< cells along the diagonal that divide a surface's light
};

/// Part of a surface, the sky, or a lamp that is not a surface.
struct Contributor {
    enum class Kind { surface, sky, lamp } kind = Kind::surface;
    std::uint32_t index = 0;  ///< index into Scene::instances or Scene::lights
    int material = -1;        ///< material of a surface: that with the most light
    glm::vec3 place{0.0f};    ///< mean position, world [m], for a surface or a lamp with one
    float distance = 0.0f;    ///< mean [m]
    glm::vec3 light{0.0f};    ///< at the lumel [lx]
};

struct Senders {
    std::vector<Contributor> list;  ///< by decreasing luminance
    std::vector<float> density;     ///< [N] luminance of a lumel's contributor per area [lx/m²]
    glm::vec3 light{0.0f};          ///< total [lx]
    /// Standard error of its luminance [lx], as if samples were not stratified: an upper bound.
    double noise = 0.0;
};

/// Traces rays from a lumel: surfaces hit send E + ρH, with H [N] [lx]; lamps are sampled
/// separately. Treats light solved with gloss as diffuse.
Senders find_senders(const SolveScene& scene, std::span<const glm::vec3> irradiance,
                     std::uint32_t lumel, const SenderOptions& options);

}  // namespace lumel
