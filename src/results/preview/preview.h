#pragma once
// Image of the lit scene, rendered on the GPU.

#include <memory>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "gpu/device.h"
#include "results/preview/view.h"

namespace lumel {

/// Content of an image.
enum class PreviewShows {
    light,   ///< radiance [cd/m²]
    map,     ///< the map on its surfaces, such as irradiance, without materials
    texels,  ///< the map with nearest-texel filtering
};

/// Memory to render an image [bytes].
struct PreviewMemory {
    std::uint64_t device = 0, host = 0;
};
PreviewMemory preview_memory(const Scene& scene, const Atlas& atlas, const glm::ivec2& size);

/// Size of an image of that width [pixels], smaller if the device cannot render it.
glm::ivec2 preview_size(const gpu::Device& device, const View& view, int width);

/// Renders several images of one scene. Pipelines, textures, meshes and unchanged parts of the map
/// stay on the device, which must outlive this.
class Preview {
public:
    Preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas);
    ~Preview();

    /// Replaces the surfaces of the scene.
    void show(const Scene& scene, const Atlas& atlas);

    /// Radiance from `view` [cd/m²], RGBA (alpha 0: no surface), `width` pixels wide (smaller if
    /// the device cannot render it). Samples the lightmap bilinearly, material textures with
    /// mipmaps. map: finished [lx], RGBA. A pixel is the mean of those of 2 × 2 samples that are on
    /// surfaces; alpha is their share, and less where only glass is. shows: selects other content,
    /// without surfaces that are less than half opaque. scene: as before, except
    /// transforms of instances, and colours and emission of materials. Valid until the next call.
    const Image& draw(const Scene& scene, const Image& map, const View& view, int width,
                      PreviewShows shows = PreviewShows::light);
    /// Display codes of the last image: tone-maps every sample before averaging, for smooth edges.
    /// exposure > 0. Requires draw().
    Image tone_mapped(float exposure);
    /// Moves the last picture out, so that there are not two of it.
    Image release();

private:
    struct Parts;

    const gpu::Device* device_;
    std::unique_ptr<Parts> parts_;
};

Image render_preview(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                     const Image& irradiance, const View& view, int width,
                     PreviewShows shows = PreviewShows::light);

}  // namespace lumel
