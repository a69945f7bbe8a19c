#pragma once
// look_from: what eyes on surfaces see, as depth. [CG85] Cohen, Greenberg. The Hemi-Cube: A
// Radiosity Solution for Complex Environments. SIGGRAPH 1985.

#include <cstdint>

#include "gpu/pacer.h"
#include "visibility/hemicube.shared.h"
#include "world/world.h"

namespace lumel {

/// Depth images of `capacity` hemicubes, side by side in one image. A kernel asks them through
/// visibility/sees.glsl, with image() bound and layout() given.
class Hemicubes {
public:
    /// side: pixels of the front face, even. The capacity given is what fits the device's images
    /// and is at most the one asked for.
    Hemicubes(const gpu::Device& device, const World& world, std::uint32_t side,
              std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    const HemicubeLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }

    /// Draws what eyes [0, count) see, in one pass. eyes: on the device, at least `count`.
    void look_from(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t count);

    /// The same in parts: face = 5 × eye + side, faces [first, last).
    void look_from_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                         std::uint32_t last);

    /// The same, face by face where one submission should not hold them all.
    void look_from(gpu::Pacer& pacer, const gpu::Array<Eye>& eyes, std::uint32_t count);

private:
    void draw_faces(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
                    std::uint32_t last);
    gpu::Area tile_area(std::uint32_t eye) const;
    gpu::Area face_area(std::uint32_t eye, std::uint32_t face) const;

    const World* world_;
    std::uint32_t capacity_;
    HemicubeLayout layout_;
    gpu::Target image_;
    gpu::Sampler sampler_;
    gpu::Raster opaque_, cut_out_;
};

}  // namespace lumel
