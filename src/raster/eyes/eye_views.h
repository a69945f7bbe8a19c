#pragma once
// Depth images of the hemisphere above surface points: hemicubes or hemispherical projections.
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

/// Pixels of a view of resolution `side` in the image.
std::uint64_t view_pixels(Projection projection, std::uint32_t side);

/// Maximum arc [rad] that a straight line may replace on a disc of this radius [pixels].
float longest_chord(float radius);

/// Depth images of `capacity` eyes, tiled in one image. Kernels read them through
/// raster/eyes/sees.glsl, with image() bound, layout() as argument, and projection() as variant.
class EyeViews {
public:
    /// side: of a hemicube's front face [pixels], even. The diameter of a hemisphere's disc is
    /// twice that: the area is then π side², and that of a hemicube 3 side². `capacity` is an upper
    /// limit; it is reduced to fit the device's images. Throws Error{input} for an invalid side,
    /// Error{device} if the device lacks tessellation, which hemispheres need.
    EyeViews(const gpu::Device& device, const World& world, Projection projection,
             std::uint32_t side, std::uint32_t capacity);

    /// GPU memory for images of any size [bytes].
    static std::uint64_t device_bytes(Projection projection, std::uint32_t side,
                                      std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    Projection projection() const { return projection_; }
    const EyeViewLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }
    std::uint32_t faces_per_eye() const;  ///< 5 for a hemicube, 1 for a hemisphere

    /// Renders the views of eyes [0, count) in one pass. eyes: on the GPU, at least `count`.
    void look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count);

    /// Renders faces [first, last), where face = faces_per_eye() × eye + side.
    void look_from_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                         std::uint32_t last);

    /// Renders the views of eyes [0, count), split by faces into submissions.
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
    std::uint32_t faces_at_once() const;  ///< maximum per pass
    void draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                    std::uint32_t last);
    LookParams look_params(std::uint32_t eye, std::uint32_t face) const;
    bool is_hemisphere() const { return projection_ == Projection::hemisphere; }

    const World* world_;
    Projection projection_;
    EyeViewLayout layout_;
    std::uint32_t capacity_;
    float radius_;  ///< hemisphere's disc radius [pixels]
    float chord_;   ///< longest_chord(radius_) [rad]
    gpu::Target image_;
    gpu::Sampler sampler_;
    Rasters rasters_;
};

}  // namespace lumel
