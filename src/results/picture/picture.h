#pragma once
// Image of a solved scene, with gloss.

#include <cstddef>
#include <span>
#include <vector>

#include "base/core/image.h"
#include "results/picture/lit_scene.h"
#include "results/picture/seen.h"

namespace lumel {

/// Radiance toward the eye without lobes [cd/m²], RGBA (alpha: covered fraction of the pixel), for
/// each layer of `lit`: emission and ρ_d H / π.
std::vector<Image> compose(const Seen& seen, const LitScene& lit);

/// Adds the light of the lobes at seen.glossy from `first` on, [points][images].
void add_reflected(std::vector<Image>& images, const Seen& seen, std::size_t first,
                   std::span<const glm::vec3> reflected);

}  // namespace lumel
