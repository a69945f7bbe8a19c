#pragma once
// Cross redistribution as in the thesis [Hoef13] 4.5: lamps are crossed as well, and movable
// objects are taken out of their old position. See paper_cross.cpp.

#include <span>
#include <vector>

#include "methods/progressive/progressive.h"
#include "methods/redistribution/cross.part.comp.h"
#include "methods/redistribution/incremental.reset.comp.h"
#include "methods/redistribution/paper_cross.gather.comp.h"
#include "methods/redistribution/paper_cross.receive.comp.h"
#include "methods/redistribution/paper_cross.shared.h"
#include "methods/redistribution/patch_sides.h"
#include "raster/eyes/lit_views.h"

namespace lumel {

/// Cross projection of [Hoef13] section 4.5.2.
enum class CrossProjection {
    whole,        ///< non-incremental: rays cross the patch in both positions
    incremental,  ///< after a move, only rays that M occludes in one of them; errors accumulate
};

/// Takes movable objects out of the solution and puts them in again, batch by batch.
class PaperCross {
public:
    /// world: the solver's, made with movers, whose lumels are kLumelMoving and have no near field.
    /// open [instances]: 1 for meshes whose backs without lumels are visible from outside. movers
    /// [instances]: 1 if movable. reprojects: false leaves out Reproject, as figure 4.5.3 does. The
    /// world, the lumels and the solver must outlive this.
    PaperCross(const gpu::Device& device, const Scene& scene, World& world, const Lumels& lumels,
               ProgressiveRadiosity& solver, const std::vector<char>& movers,
               const std::vector<char>& open, CrossProjection projection, bool reprojects = true);

    /// Starts to take movable objects out of their position in the world, if they are in the
    /// solution, and to put them in at `transforms` [instances]. Requires !is_under_way().
    void begin(std::vector<glm::mat4> transforms, bool has_moved);
    /// Runs one batch. Returns false when finished.
    bool step();
    bool is_under_way() const { return phase_ != Phase::none; }
    /// Total. A patch's front in its new position is rendered twice, for depth and for light: the
    /// thesis draws both at once, and has 4 |M|.
    std::uint64_t hemicubes() const { return hemicubes_; }

private:
    enum class Phase { none, out, in };
    /// Triangle of a movable instance in the mesh.
    struct LocalTriangle {
        std::uint32_t instance;
        MoverTriangle corners;
    };

    void put_in();
    void gather();
    void receive();
    gpu::Array<MoverTriangle> triangles_at(std::span<const glm::mat4> transforms) const;
    SurfaceLight light_of_still() const;

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    gpu::Kernel<shaders::CrossPart> part_;
    gpu::Kernel<shaders::IncrementalReset> reset_;
    gpu::Kernel<shaders::PaperCrossGather> gather_;
    gpu::Kernel<shaders::PaperCrossReceive> receive_;
    PatchSides sides_;
    LitViews front_views_;
    gpu::Array<std::uint32_t> lumel_of_;  ///< [texels][2]
    gpu::Array<float> delta_form_factors_;
    gpu::Array<std::uint32_t> is_mover_;  ///< [instances]
    gpu::Array<std::uint32_t> of_mover_;  ///< [N]
    gpu::Array<glm::vec3> crossed_;       ///< [N] B^s of C that M's effect was computed from
    std::vector<LocalTriangle> local_triangles_;
    gpu::Array<MoverTriangle> triangles_;  ///< of M in its other position
    std::vector<glm::mat4> after_;         ///< [instances] transforms to put M in at
    bool reprojects_;
    bool culls_ = false;      ///< this redistribution is incremental
    bool inserted_ = false;   ///< M is in the solution
    std::uint32_t next_ = 0;  ///< next entry of the list
    Phase phase_ = Phase::none;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
