#pragma once
// Image of a solved scene, with gloss.

#include <span>
#include <vector>

#include "base/core/image.h"
#include "results/picture/lit_scene.h"
#include "results/picture/seen.h"

namespace lumel {

/// Radiance toward the eye [cd/m²], RGBA (alpha: covered fraction of the pixel), for each layer of
/// `lit`: emission, ρ_d H / π, and `reflected` [G][layers], the light of the lobes at seen.glossy.
std::vector<Image> compose(const Seen& seen, const LitScene& lit,
                           std::span<const glm::vec3> reflected);

}  // namespace lumel
