#pragma once
// A picture of a solved scene, gloss and all.

#include <span>

#include "base/core/image.h"
#include "results/picture/lit_scene.h"
#include "results/picture/seen.h"

namespace lumel {

/// Radiance toward the eye [cd/m²], RGBA (alpha: share of the pixel where something is): what is
/// emitted, ρ_d H / π, and `reflected` [G], what the lobes add at seen.glossy.
Image compose(const Seen& seen, const LitScene& lit, std::span<const glm::vec3> reflected);

}  // namespace lumel
