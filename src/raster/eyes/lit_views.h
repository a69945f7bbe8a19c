#pragma once
// look_from in colour: the radiosity that eyes on surfaces see, on hemicubes.
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

/// The surfaces' light: what lit views show.
struct SurfaceLight {
    const gpu::Array<std::uint32_t>* lumel_of;  ///< [texels][2] of each side, or kNoLumel
    const gpu::Array<glm::vec3>* radiosity;     ///< B [N] [lm/m²]
    std::uint32_t width, height;                ///< of the atlas [texels]
};

/// Images of what `capacity` eyes see, side by side, each pixel in kManySamples samples: radiosity,
/// and near / distance along the face's axis, 0 where nothing is seen. A kernel reads those by
/// texelFetch from a sampler2DMS, in tiles as EyeViewLayout has them for hemicubes.
class LitViews {
public:
    /// side: pixels of a hemicube's front face, even. near: closer surfaces are not seen [m]. The
    /// capacity given is what fits the device's images and is at most the one requested. `world`
    /// must hold the atlas.
    /// Throws Error{input} if the side will not do, Error{device} if the device cannot clip.
    LitViews(const gpu::Device& device, const World& world, std::uint32_t side, float near,
             std::uint32_t capacity);

    /// Bytes on a device whose images may be as large as is wanted.
    static std::uint64_t device_bytes(std::uint32_t side, std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    const EyeViewLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }

    /// Draws what eyes [0, count) see, hull and all. eyes: on the device, at least `count`.
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
