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
    bool is_under_way() const { return phases_.is_under_way(); }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< total over all moves

private:
    void begin_phases();
    void go_after();
    void receive(bool takes_back);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    gpu::Kernel<shaders::PaperIncrementalReset> reset_;
    gpu::Kernel<shaders::PaperIncrementalReceive> receive_;
    gpu::Array<std::uint32_t> moved_;     ///< [instances] 1: it moves
    gpu::Array<PatchShot> shot_before_;   ///< [K] B^s of the batch
    ShotPhases phases_;                   ///< R_p(M, C); R_p(C, M) and R_p(C, C) after the move
    gpu::Array<ChosenPatch> after_shot_;  ///< list after the move, sending shot light
    Move move_;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
