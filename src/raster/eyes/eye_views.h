#pragma once
// look_from: what eyes on surfaces see, as depth, by one of two projections of the hemisphere.
//
//   [CG85] Cohen, Greenberg. The Hemi-Cube: A Radiosity Solution for Complex Environments. 1985.
//   [BJ04] Barsi, Jakab. Stream Processing in Global Illumination. 2004, section 3.2.

#include <cstdint>
#include <variant>

#include "gpu/pacer.h"
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemicube.cut_out.raster.h"
#include "raster/eyes/hemicube.raster.h"
#include "raster/eyes/hemisphere_cuts.h"
#include "raster/eyes/view_options.h"
#include "raster/world/surface_rasters.h"
#include "raster/world/world.h"

namespace lumel {

/// Pixels that a view of resolution `side` takes in the image.
std::uint64_t view_pixels(Projection projection, std::uint32_t side);

/// The longest arc [rad] that one straight line may stand for on a disc of that radius [pixels].
float longest_chord(float radius);

/// Depth images of what `capacity` eyes see, side by side in one image. A kernel reads them through
/// raster/eyes/sees.glsl, with image() bound, layout() given, and projection() as its variant.
class EyeViews {
public:
    /// side: pixels of a hemicube's front face, even. A hemisphere's disc measures twice that: then
    /// its area is π side², a hemicube's 3 side². The capacity given is what fits the device's
    /// images and is at most the one requested.
    /// Throws Error{input} if the side cannot be used, Error{device} if the device cannot
    /// tessellate, which hemispheres need.
    EyeViews(const gpu::Device& device, const World& world, Projection projection,
             std::uint32_t side, std::uint32_t capacity);

    /// Bytes on a device whose images may be as large as is wanted.
    static std::uint64_t device_bytes(Projection projection, std::uint32_t side,
                                      std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    Projection projection() const { return projection_; }
    const EyeViewLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }
    std::uint32_t faces_per_eye() const;  ///< 5 of a hemicube, 1 of a hemisphere

    /// Draws what eyes [0, count) see, in one pass. eyes: on the device, at least `count`.
    void look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count);

    /// The same in parts: face = faces_per_eye() × eye + side, faces [first, last).
    void look_from_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                         std::uint32_t last);

    /// The same, face by face where one submission should not hold them all.
    void look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, std::uint32_t count);

private:
    using HemicubeRasters = SurfaceRasters<shaders::Hemicube, shaders::HemicubeCutOut>;
    using Rasters = std::variant<HemicubeRasters, HemisphereCuts>;

    Rasters make_rasters(const gpu::Device& device) const;
    void cut(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
             std::uint32_t last);
    LookParams begin_face(gpu::Commands& commands, std::uint32_t eye, std::uint32_t face) const;
    void draw_hemicubes(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                        std::uint32_t last);
    std::uint32_t faces_at_once() const;  ///< what one pass can hold
    void draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                    std::uint32_t last);
    LookParams look_params(std::uint32_t eye, std::uint32_t face) const;
    bool is_hemisphere() const { return projection_ == Projection::hemisphere; }

    const World* world_;
    Projection projection_;
    EyeViewLayout layout_;
    std::uint32_t capacity_;
    float radius_;  ///< of a hemisphere's disc [pixels]
    float chord_;   ///< longest_chord(radius_) [rad]
    gpu::Target image_;
    gpu::Sampler sampler_;
    Rasters rasters_;
};

}  // namespace lumel
