#pragma once
// Incremental radiosity merged with a progressive iteration [Hoef13] 4.4. See
// paper_incremental.cpp.

#include "methods/redistribution/incremental.h"
#include "methods/redistribution/paper_incremental.receive.comp.h"
#include "methods/redistribution/paper_incremental.reset.comp.h"
#include "methods/redistribution/paper_incremental.shared.h"

namespace lumel {

/// Redistributes shot light and shoots the unshot light of static patches, batch by batch.
class PaperIncremental {
public:
    /// world: the solver's, made with movers. rows: for the geometry in the world. All must outlive
    /// this.
    PaperIncremental(const gpu::Device& device, World& world, const Lumels& lumels,
                     ProgressiveRadiosity& solver, VisibilityRows& rows);

    /// Starts to correct the solution for a move. Requires !is_under_way(). Returns false if there
    /// is no work: no light was shot yet.
    bool begin(Move move);
    /// Runs one batch. Returns false when finished: the world is then as after the move, the light
    /// of moved patches is unshot, and the caller sets the near field.
    bool step();
    bool is_under_way() const { return phase_ != Phase::none; }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< total over all moves

private:
    /// Phases, each over a list of patches, in this order.
    enum class Phase {
        none,
        before,  ///< patches of unknown visibility render the world before the move
        back,    ///< moved patches take their light back, R_p(M, C)
        after,   ///< static patches render the world after the move, R_p(C, M) and R_p(C, C)
    };

    void make_lists();
    void go_to(Phase phase);
    const ShotList& list() const;
    void receive(bool takes_back);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    gpu::Kernel<shaders::PaperIncrementalReset> reset_;
    gpu::Kernel<shaders::PaperIncrementalReceive> receive_;
    gpu::Array<std::uint32_t> moved_;    ///< [instances] 1: it moves
    gpu::Array<PatchShot> shot_before_;  ///< [K] B^s of the batch
    ShotList before_list_, back_list_, after_list_;
    gpu::Array<ChosenPatch> after_shot_;  ///< after_list_, sending shot light
    Move move_;
    std::uint32_t next_ = 0;  ///< next entry of the list
    Phase phase_ = Phase::none;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
