#pragma once
// Incremental radiosity [Hoef13] 4.4: a progressive solution is corrected, not solved again, when
// something moves. See incremental.cpp.

#include <functional>

#include "live/incremental.receive.comp.h"
#include "live/incremental.reset.comp.h"
#include "live/incremental.shared.h"
#include "solve/progressive.h"

namespace lumel {

/// A move of some instances.
struct Move {
    std::vector<std::uint32_t> moved;   ///< [instances] 1: it moves
    std::vector<glm::mat4> transforms;  ///< [instances] where all are after it
    std::vector<MovedBox> boxes;        ///< what moves, before and after
};

/// Redistributes what was shot, batch by batch.
class IncrementalRedistribution {
public:
    /// world: the solver's, made with movers. All must outlive it.
    IncrementalRedistribution(const gpu::Device& device, World& world, const Lumels& lumels,
                              ProgressiveRadiosity& solver, Projection projection);

    /// Begins to correct the solution for a move. Nothing may be under way.
    void begin(Move move);
    /// One batch. Returns false once nothing is left to do; then the world is as after the move,
    /// and the solver may go on (the light of close pairs is for the caller: set_near_field()).
    bool step();
    bool is_under_way() const { return sign_ != 0.0f; }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< of all moves so far

private:
    std::vector<ChosenPatch> patches_to_shoot() const;
    void receive();

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    gpu::Kernel<shaders::IncrementalReceive> receive_;
    gpu::Kernel<shaders::IncrementalReset> reset_;
    gpu::Array<std::uint32_t> moved_;
    gpu::Array<MovedBox> boxes_;
    gpu::Array<ChosenPatch> list_;
    Move move_;
    std::vector<glm::mat4> before_;  ///< [instances] where all were
    std::uint32_t next_ = 0;         ///< of the list
    float sign_ = 0.0f;              ///< -1: taking back, 1: sending anew, 0: nothing to do
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
