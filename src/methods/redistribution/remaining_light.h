#pragma once
// Shoots the light that a redistribution leaves, from the few patches that have most of it.

#include <vector>

#include "methods/progressive/progressive.h"
#include "methods/progressive/visibility_rows.h"

namespace lumel {

/// Shoots from the patches with the most light left, in rounds.
class RemainingLight {
public:
    /// rows: for the geometry in the world during step(). All must outlive this.
    RemainingLight(ProgressiveRadiosity& solver, VisibilityRows& rows);

    /// Chooses patches, so that at most the fraction `left` of the unshot light is outside them.
    /// Returns false, and chooses none, if charts that never shot have more: they have no level
    /// yet. Waits for the device.
    bool begin(double left);
    bool is_under_way() const { return at_ < lists_.size(); }
    /// Shoots one batch of the chosen patches.
    void step();
    /// Discards the chosen patches.
    void drop() { lists_.clear(); }

    std::uint64_t hemicubes() const { return hemicubes_; }  ///< total

private:
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    std::vector<ShotList> lists_;  ///< visibility stored, to be stored, without rows
    std::size_t at_ = 0;           ///< current list
    std::uint32_t next_ = 0;       ///< next patch of the list
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
