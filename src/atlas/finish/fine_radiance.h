#pragma once
// Radiance of surfaces at the density of their textures.

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel {

/// Texels of colour and emission textures per side of an atlas texel, at least 1: sufficient for
/// nearly all textured area.
int texture_density(const Scene& scene, const Atlas& atlas);

/// Radiance L = ρ H / π + L_e [cd/m²], RGBA, of the atlas with `scale`² texels per atlas texel.
/// Colour and emission are sampled at this density; light is interpolated in `irradiance` [lx], the
/// finished map. `radiance`: the finished map of L [cd/m²], for parts thinner than a texel. All
/// texels are filled; alpha is 0 outside surfaces.
Image fine_radiance(const Scene& scene, const Atlas& atlas, const Image& irradiance,
                    const Image& radiance, int scale);

}  // namespace lumel
