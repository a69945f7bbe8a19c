#pragma once
// A picture of the lit scene, drawn on the device that solved it.

#include <memory>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "gpu/device.h"
#include "results/preview/view.h"

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

/// Pictures of one scene, one after another. What stays is kept on the device: pipelines, textures,
/// meshes, and of the map what has not changed. The device must outlive it.
class Preview {
public:
    Preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas);
    ~Preview();

    /// Shows other surfaces of the same scene from now on.
    void show(const Scene& scene, const Atlas& atlas);

    /// Radiance [cd/m²] as seen from `view`, RGBA (alpha 0: nothing there), `width` pixels wide
    /// (narrower where the device cannot draw that). The lightmap is sampled bilinearly, material
    /// textures with mipmaps. `map`: finished [lx], RGBA. One pixel is the mean of 2 × 2. What
    /// `shows` says may be shown instead. `scene`: as before, but for places of instances, which
    /// keep their shape, and for colours and emission of materials. Good until the next call.
    const Image& draw(const Scene& scene, const Image& map, const View& view, int width,
                      PreviewShows shows = PreviewShows::light);
    /// Moves the last picture out, so that there are not two of it.
    Image release();

private:
    struct Parts;

    const gpu::Device* device_;
    std::unique_ptr<Parts> parts_;
};

/// One such picture alone.
Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width,
                     PreviewShows shows = PreviewShows::light);

}  // namespace lumel
