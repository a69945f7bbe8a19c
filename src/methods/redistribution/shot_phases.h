#pragma once
// Phases of a redistribution over patches that shoot.

#include "methods/progressive/visibility_rows.h"

namespace lumel {

/// Lists of patches that shoot one after the other, batch by batch.
class ShotPhases {
public:
    enum class Phase {
        none,
        before,  ///< patches of unknown visibility see the world before the move
        back,    ///< moving patches take their light back
        after,   ///< the world is as after the move
    };

    explicit ShotPhases(const VisibilityRows& rows);

    /// Starts the first phase that has work; Phase::after if none has.
    void begin(ShotList before, ShotList back, ShotList after);
    /// Passes over a batch. Returns true if Phase::after begins with it, even without work.
    bool pass(std::uint32_t batch);
    /// Ends Phase::after if it has no work.
    void end_if_empty();

    Phase phase() const { return phase_; }
    bool is_under_way() const { return phase_ != Phase::none; }
    const ShotList& list() const;                 ///< of the phase
    std::uint32_t next() const { return next_; }  ///< first entry of the batch
    const ShotList& back() const { return back_; }

private:
    void go_to(Phase phase);

    ShotList before_, back_, after_;
    std::uint32_t next_ = 0;
    Phase phase_ = Phase::none;
};

}  // namespace lumel
