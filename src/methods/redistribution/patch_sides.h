#pragma once
// Views from the fronts of movable patches, and of the light behind them [Hoef13] 4.5.

#include "methods/progressive/progressive.h"
#include "methods/redistribution/cross.back_eyes.comp.h"
#include "methods/redistribution/cross.resolve.comp.h"
#include "methods/redistribution/cross.shared.h"
#include "raster/eyes/lit_views.h"

namespace lumel {

/// All movable patches M in batches: fronts, and backs of those of open meshes.
class PatchSides {
public:
    /// open [instances]: 1 for meshes whose backs without lumels are visible from outside.
    /// back_side: of the front face of a back hemicube [pixels], divisible
    /// by 2^levels. The world and the solver must outlive this.
    PatchSides(const gpu::Device& device, World& world, const Lumels& lumels,
               ProgressiveRadiosity& solver, const std::vector<char>& open, std::uint32_t back_side,
               std::uint32_t levels);

    std::uint32_t batch() const { return batch_; }        ///< K
    std::size_t size() const { return patches_.size(); }  ///< |M|
    std::size_t listed() const { return list_.size(); }   ///< entries in whole batches

    /// Takes the batch at `first`; its patches see the world with what moves.
    void look_from_fronts(std::uint32_t first);
    /// Their backs see the light of the world without what moves: back().
    void look_from_backs(const SurfaceLight& light);

    const BackLayout& back_layout() const { return back_layout_; }
    gpu::Array<BackPixel>& back() { return back_; }  ///< [K][pixels of all levels]

private:
    World* world_;
    ProgressiveRadiosity* solver_;
    gpu::Kernel<shaders::CrossBackEyes> back_eyes_kernel_;
    gpu::Kernel<shaders::CrossResolve> resolve_;
    std::uint32_t batch_, levels_;
    LitViews views_;
    BackLayout back_layout_;
    std::vector<ChosenPatch> patches_;
    gpu::Array<ChosenPatch> list_;
    gpu::Array<Eye> back_eyes_;  ///< [K]
    gpu::Array<BackPixel> back_;
};

}  // namespace lumel
