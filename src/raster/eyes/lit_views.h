#pragma once
// Radiosity images of hemicubes at surface points.
//
//   [CG85]   Cohen, Greenberg. The Hemi-Cube: A Radiosity Solution for Complex Environments. 1985.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//   2013.

#include <cstdint>

#include "gpu/pacer.h"
#include "raster/eyes/lit.cut_out.raster.h"
#include "raster/eyes/lit.raster.h"
#include "raster/eyes/lit_views.shared.h"
#include "raster/world/surface_rasters.h"
#include "raster/world/world.h"

namespace lumel {

/// Light of the surfaces, for lit views.
struct SurfaceLight {
    const gpu::Array<std::uint32_t>* lumel_of;  ///< [texels][2] per side, or kNoLumel
    const gpu::Array<glm::vec3>* radiosity;     ///< B [N] [lm/m²]
    std::uint32_t width, height;                ///< atlas size [texels]
};

/// Images of `capacity` eyes, tiled in one image, with kManySamples samples per pixel: radiosity,
/// and near / distance along the face's axis, 0 without a surface. Kernels read them by texelFetch
/// from a sampler2DMS, in the hemicube tiles of EyeViewLayout.
class LitViews {
public:
    /// side: of a hemicube's front face [pixels], even. near: minimum distance of visible surfaces
    /// [m]. `capacity` is an upper limit; it is reduced to fit the device's images. `world` must
    /// have the atlas. Throws Error{input} for an invalid side, Error{device} if the device lacks
    /// clip distances.
    LitViews(const gpu::Device& device, const World& world, std::uint32_t side, float near,
             std::uint32_t capacity);

    /// GPU memory for images of any size [bytes].
    static std::uint64_t device_bytes(std::uint32_t side, std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    const EyeViewLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }

    /// Renders the views of eyes [0, count), including the hull. eyes: on the GPU, at least
    /// `count`.
    void look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, const SurfaceLight& light,
                   std::uint32_t count);

private:
    void draw(gpu::Commands& commands, const gpu::Array<Eye>& eyes, const SurfaceLight& light,
              std::uint32_t first, std::uint32_t last);

    const World* world_;
    EyeViewLayout layout_;
    std::uint32_t capacity_;
    gpu::Target image_, depth_;
    gpu::Sampler sampler_;
    SurfaceRasters<shaders::Lit, shaders::LitCutOut> rasters_;
};

}  // namespace lumel
