#pragma once
// A picture of the lit scene, drawn on the device that solved it.

#include "atlas/atlas.h"
#include "core/image.h"
#include "gpu/device.h"
#include "preview/view.h"

namespace lumel {

/// Radiance [cd/m²] as seen from `view`, RGBA (alpha 0: nothing there), `width` pixels wide
/// (narrower where the device cannot draw that).
/// The lightmap is sampled bilinearly, material textures with mipmaps. `irradiance`: the
/// finished map [lx], RGBA. One pixel is the mean of 2 × 2.
Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width);

}  // namespace lumel
