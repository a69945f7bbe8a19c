#pragma once
// Cross-redistribution radiosity [Hoef13] 4.5: movable objects receive, send and occlude light, at
// the cost of hemicubes on these alone. See cross.cpp.

#include "methods/progressive/progressive.h"
#include "methods/redistribution/cross.gather.comp.h"
#include "methods/redistribution/cross.part.comp.h"
#include "methods/redistribution/cross.receive.comp.h"
#include "methods/redistribution/cross.send.comp.h"
#include "methods/redistribution/cross.settle.comp.h"
#include "methods/redistribution/cross.shared.h"
#include "methods/redistribution/lamp_shadows.h"
#include "methods/redistribution/patch_sides.h"

namespace lumel {

struct CrossOptions {
    /// Points of a lamp that shoot past movable objects, at least 1: the coarsest level with as
    /// many is used, or the solution's own. Where the solution shoots from more, shadows of these
    /// objects are coarser than in a solution from scratch.
    std::uint32_t lamp_points = 256;
};

/// Redistributes light shot among static lumels, batch by batch.
class CrossRedistribution {
public:
    /// world: the solver's, made with movers, whose lumels are kLumelMoving. open [instances]: 1
    /// for meshes whose backs without lumels are visible from outside. movers [instances]: 1 if
    /// movable. most_bytes: VisibilityRows. All but the last four must outlive this.
    CrossRedistribution(const gpu::Device& device, World& world, const Lumels& lumels,
                        ProgressiveRadiosity& solver, const std::vector<char>& movers,
                        const std::vector<char>& open, const CrossOptions& options,
                        std::uint64_t most_bytes);

    /// Sets pairs with a movable lumel, for the next positions of instances. Requires
    /// !is_under_way().
    void set_near_field(const NearField& near);
    /// Starts to recompute the effect of movable patches at their positions in the world, inside
    /// `boxes`. has_moved: since the last begin(). Ignores changes of the lamps' light up to
    /// `tolerance`. Requires !is_under_way().
    void begin(const std::vector<MovedBox>& boxes, bool has_moved, double tolerance);
    /// Runs one batch. Returns false when finished.
    bool step();
    bool is_under_way() const { return under_way_; }
    /// Total of fronts, backs and lamps.
    std::uint64_t hemicubes() const { return hemicubes_ + lamps_.hemicubes(); }

private:
    void begin_crossing();
    void gather();
    void receive();

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    gpu::Kernel<shaders::CrossPart> part_;
    gpu::Kernel<shaders::CrossGather> gather_;
    gpu::Kernel<shaders::CrossSend> send_;
    gpu::Kernel<shaders::CrossReceive> receive_;
    gpu::Kernel<shaders::CrossSettle> settle_;
    LampShadows lamps_;
    PatchSides sides_;
    gpu::Array<std::uint32_t> lumel_of_;                  ///< [texels][2]
    gpu::Array<std::uint32_t> near_first_, near_column_;  ///< static rows, movable columns
    gpu::Array<float> near_factor_;
    gpu::Array<glm::vec3> crossed_;           ///< [N] B^s without the lamps'
    gpu::Array<glm::vec3> fresh_, crossing_;  ///< [N] effect of movable patches: new, current
    std::uint32_t next_ = 0;                  ///< next entry of the list
    bool under_way_ = false;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
