#pragma once
// The accumulation texture of [BSS05]: light that lumels reflect to an eye, computed per lumel
// instead of per pixel.

#include <span>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "atlas/packing/atlas.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "methods/glossy/eye_image.h"
#include "results/picture/seen.h"
#include "scene/values/view.h"

namespace lumel {

/// Centres of the lumels that have lobes and face the eye.
struct LumelSight {
    std::vector<EyePoint> points;       ///< [P]
    std::vector<std::uint32_t> lumels;  ///< [P] lumel of each
};

LumelSight see_lumels(const View& view, const WorldLumels& world, const Lumels& lumels);

/// radiance [P] of a sight as a value per lumel [N]; 0 for lumels not in it.
std::vector<glm::vec3> by_lumel(const LumelSight& sight, std::span<const glm::vec3> radiance,
                                std::size_t lumel_count);

/// The texture's light at the glossy points that an eye sees [G] [cd/m²]. front, back: its maps, as
/// in LitScene.
std::vector<glm::vec3> look_up(const Seen& seen, const SolveScene& scene, const Image& front,
                               const Image& back);

}  // namespace lumel
