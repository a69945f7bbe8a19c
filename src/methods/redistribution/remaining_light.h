#pragma once
// What redistribution leaves to be shot: few patches have most of it, and they shoot it first.

#include <vector>

#include "methods/progressive/progressive.h"
#include "methods/redistribution/visibility_rows.h"

namespace lumel {

/// Shoots from the patches with the most light left, in rounds.
class RemainingLight {
public:
    /// rows: of what is in the world when step() is called. All must outlive it.
    RemainingLight(ProgressiveRadiosity& solver, VisibilityRows& rows);

    /// Chooses patches, so that of the light still to be shot no more than `left` of it is outside
    /// them. False, and nothing is chosen, where charts have more that never shot: the solver has
    /// not chosen how finely yet. Waits for the device.
    bool begin(double left);
    bool is_under_way() const { return at_ < lists_.size(); }
    /// One batch of what was chosen.
    void step();
    /// What is chosen is not shot.
    void drop() { lists_.clear(); }

    std::uint64_t hemicubes() const { return hemicubes_; }  ///< so far

private:
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    std::vector<ShotList> lists_;  ///< of patches whose views are kept, are to be, and cannot be
    std::size_t at_ = 0;           ///< of them
    std::uint32_t next_ = 0;       ///< of its patches
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
