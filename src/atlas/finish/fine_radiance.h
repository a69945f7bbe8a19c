#pragma once
// What surfaces send, at the density of their own textures.

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel {

/// Texels of the scene's textures of colour and emission along the side of an atlas texel, at least
/// 1: as many as nearly all of the surface under textures has, or fewer.
int texture_density(const Scene& scene, const Atlas& atlas);

/// Radiance L = ρ H / π + L_e [cd/m²], RGBA, of the atlas with `scale` texels for each of its own:
/// colour and emission as the materials have them there, and light between texels of `irradiance`
/// [lx], the finished map. `radiance`: the finished map of L [cd/m²], for what is thinner than a
/// texel. All texels are filled; alpha is 0 where no surface is.
Image fine_radiance(const Scene& scene, const Atlas& atlas, const Image& irradiance,
                    const Image& radiance, int scale);

}  // namespace lumel
