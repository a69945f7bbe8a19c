#pragma once
// A picture of the lit scene, drawn on the device that solved it.

#include "atlas/atlas.h"
#include "core/image.h"
#include "gpu/device.h"
#include "preview/view.h"

namespace lumel {

/// What a picture shows of the scene.
enum class PreviewShows {
    light,   ///< radiance [cd/m²]
    map,     ///< the map on its surfaces, such as irradiance, whatever their paint
    texels,  ///< the same, each texel of one colour
};

/// Bytes that it takes to draw a picture.
struct PreviewMemory {
    std::uint64_t device = 0, host = 0;
};
PreviewMemory preview_memory(const Scene& scene, const Atlas& atlas, const glm::ivec2& size);

/// Pixels of a picture of that width, narrower where the device cannot draw that.
glm::ivec2 preview_size(const gpu::Device& device, const View& view, int width);

/// Radiance [cd/m²] as seen from `view`, RGBA (alpha 0: nothing there), `width` pixels wide
/// (narrower where the device cannot draw that).
/// The lightmap is sampled bilinearly, material textures with mipmaps. `irradiance`: the
/// finished map [lx], RGBA. One pixel is the mean of 2 × 2. What `shows` says may be shown instead.
Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width,
                     PreviewShows shows = PreviewShows::light);

}  // namespace lumel
