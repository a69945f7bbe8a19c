#pragma once
// Incremental radiosity [Hoef13] 4.4: a progressive solution is corrected, not solved again, when
// something moves. See incremental.cpp.

#include <functional>

#include "methods/progressive/progressive.h"
#include "methods/redistribution/incremental.receive.comp.h"
#include "methods/redistribution/incremental.reset.comp.h"
#include "methods/redistribution/incremental.shared.h"
#include "methods/redistribution/visibility_rows.h"

namespace lumel {

/// A move of some instances.
struct Move {
    std::vector<std::uint32_t> moved;   ///< [instances] 1: it moves
    std::vector<glm::mat4> transforms;  ///< [instances] where all are after it
    std::vector<MovedBox> boxes;        ///< what moves, before and after
};

/// The angle [rad] by which views may show an edge to stand out.
float edge_slack(const EyeViewLayout& views);

/// May the patch see what moves, before or after? Where instances stood before: `places`.
bool may_see(const Move& move, const Lumels& lumels, const std::vector<glm::mat4>& places,
             const Patch& patch, float slack);

/// Redistributes what was shot, batch by batch.
class IncrementalRedistribution {
public:
    /// world: the solver's, made with movers. rows: of what is in the world. All must outlive it.
    IncrementalRedistribution(const gpu::Device& device, World& world, const Lumels& lumels,
                              ProgressiveRadiosity& solver, VisibilityRows& rows,
                              Projection projection);

    /// Begins to correct the solution for a move. Nothing may be under way. False if that is all:
    /// nothing was shot yet.
    bool begin(Move move);
    /// One batch. Returns false once nothing is left to do; then the world is as after the move,
    /// and the solver may go on (the light of close pairs is for the caller: set_near_field()).
    bool step();
    bool is_under_way() const { return phase_ != Phase::none; }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< of all moves so far

private:
    /// What is done, in this order, to one list of patches after the other.
    enum class Phase {
        none,
        before,  ///< those of which it is not known see the world as it was
        back,    ///< those that move take their light back
        after,   ///< all see the world as it is, and redistribute
    };
    struct Patches3 {
        std::vector<ChosenPatch> unknown, moving, all;
    };

    Patches3 patches_to_shoot();
    void go_to(Phase phase);
    const ShotList& list() const;
    void look();
    void receive(float sign);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    gpu::Kernel<shaders::IncrementalReceive> receive_;
    gpu::Kernel<shaders::IncrementalReset> reset_;
    gpu::Array<std::uint32_t> moved_;
    gpu::Array<MovedBox> boxes_;
    ShotList before_list_, back_list_, after_list_;
    Move move_;
    std::vector<glm::mat4> before_;  ///< [instances] where all were
    std::uint32_t next_ = 0;         ///< of the list
    Phase phase_ = Phase::none;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
