#pragma once
// The accumulation texture of [BSS05]: what lumels reflect to an eye, found once for each and not
// for the points behind pixels.

#include <span>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "methods/glossy/eye_image.h"
#include "results/picture/seen.h"
#include "scene/values/view.h"

namespace lumel {

/// The centres of those lumels that have lobes and face the eye.
struct LumelSight {
    std::vector<EyePoint> points;       ///< [P]
    std::vector<std::uint32_t> lumels;  ///< [P] whose they are
};

LumelSight see_lumels(const View& view, const WorldLumels& world, const Lumels& lumels);

/// radiance [P] of a sight as a value for each lumel [N]; 0 for those left out.
std::vector<glm::vec3> by_lumel(const LumelSight& sight, std::span<const glm::vec3> radiance,
                                std::size_t lumel_count);

/// What the texture says of the glossy points that an eye sees [G] [cd/m²]. front, back: its maps,
/// as LitScene takes them.
std::vector<glm::vec3> look_up(const Seen& seen, const Scene& scene, const Atlas& atlas,
                               const Lumels& lumels, const Image& front, const Image& back);

}  // namespace lumel
