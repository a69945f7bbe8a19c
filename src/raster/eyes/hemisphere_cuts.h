#pragma once
// Culls and subdivides triangles on the GPU for hemispherical projection, per eye: into strips, or
// by tessellation if no strip fits.

#include <cstdint>
#include <functional>
#include <vector>

#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.count.comp.h"
#include "raster/eyes/hemisphere.cut.comp.h"
#include "raster/eyes/hemisphere.cut_out.raster.h"
#include "raster/eyes/hemisphere.place.comp.h"
#include "raster/eyes/hemisphere.raster.h"
#include "raster/eyes/hemisphere.strip.cut_out.raster.h"
#include "raster/eyes/hemisphere.strip.raster.h"
#include "raster/world/surface_rasters.h"
#include "raster/world/world.h"

namespace lumel {

class HemisphereCuts {
public:
    /// capacity: maximum eyes per cut().
    HemisphereCuts(const gpu::Device& device, const World& world, std::uint32_t capacity);

    /// GPU memory [bytes] if the scene's triangles fit at once.
    static std::uint64_t device_bytes();

    std::uint32_t eyes_at_once() const { return eyes_at_once_; }

    /// Subdivides the world's triangles for eyes [first, first + count), outside of a pass. count:
    /// at most eyes_at_once(). near [m], radius [pixels], chord [rad]: see LookParams and
    /// longest_chord().
    void cut(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
             std::uint32_t count, float near, float radius, float chord);

    /// Draws them for eyes [first, last) of those, inside a pass. begin_eye: sets an eye's viewport
    /// and returns the common parameters of its draws.
    void draw(gpu::Commands& commands, const gpu::Array<Eye>& eyes, std::uint32_t first,
              std::uint32_t last, const std::function<LookParams(std::uint32_t)>& begin_eye) const;

private:
    /// Triangles with one material state.
    struct Part {
        gpu::Range range;
        const CutOutDraw* cut_out;  ///< null: opaque
        std::uint32_t first_block, blocks;
    };

    using StripRasters = SurfaceRasters<shaders::HemisphereStrip, shaders::HemisphereStripCutOut>;
    using PatchRasters = SurfaceRasters<shaders::Hemisphere, shaders::HemisphereCutOut>;

    std::vector<Part> parts() const;
    template <class Shaders>
    gpu::Drawing<Shaders> use(gpu::Commands& commands, const gpu::Raster<Shaders>& raster,
                              const gpu::Array<Eye>& eyes) const;
    template <class Shaders>
    gpu::Drawing<Shaders> use(gpu::Commands& commands, const gpu::Raster<Shaders>& raster,
                              const gpu::Array<Eye>& eyes, const CutOutDraw& cut_out) const;
    std::uint32_t draw_index(std::uint32_t eye, std::size_t part) const;

    const World* world_;
    std::uint32_t eye_blocks_, eye_draws_, eyes_at_once_;
    std::uint32_t first_eye_ = 0;        ///< argument of the last cut()
    gpu::Array<std::uint32_t> cuts_;     ///< [eyes_at_once][slots]
    gpu::Array<CutCount> counts_;        ///< [eyes_at_once][slots]
    gpu::Array<CutCount> block_counts_;  ///< [eyes_at_once][eye_blocks]
    gpu::Array<DrawnVertices> draws_;    ///< [eyes_at_once][eye_draws]
    gpu::Kernel<shaders::HemisphereCut> cut_;
    gpu::Kernel<shaders::HemisphereCount> count_;
    gpu::Kernel<shaders::HemispherePlace> place_;
    StripRasters strips_;
    PatchRasters patches_;
};

}  // namespace lumel
