#pragma once
// Incremental radiosity [Hoef13] 4.4: corrects a progressive solution when objects move. See
// incremental.cpp.

#include <functional>

#include "methods/progressive/progressive.h"
#include "methods/progressive/visibility_rows.h"
#include "methods/redistribution/incremental.receive.comp.h"
#include "methods/redistribution/incremental.reset.comp.h"
#include "methods/redistribution/incremental.shared.h"
#include "methods/redistribution/shot_phases.h"

namespace lumel {

struct Move {
    std::vector<std::uint32_t> moved;   ///< [instances] 1: it moves
    std::vector<glm::mat4> transforms;  ///< [instances] transforms after the move
    std::vector<MovedBox> boxes;        ///< bounds of moved instances, before and after
};

/// Flags of instances as the device reads them.
inline std::vector<std::uint32_t> words_of(const std::vector<char>& flags)
{
    return {flags.begin(), flags.end()};
}

/// Angle [rad] by which an edge can seem to protrude in the views.
float edge_slack(const EyeViewLayout& views);

/// True if the patch can see moved instances, before or after. places: transforms of instances
/// before.
bool may_see(const Move& move, const Lumels& lumels, const std::vector<glm::mat4>& places,
             const Patch& patch, float slack);

/// Redistributes shot light between the pairs that moved instances can affect.
struct PairRedistribution {
    PairRedistribution(const gpu::Device& device, ProgressiveRadiosity& solver,
                       std::size_t instances);

    /// Adds light of the batch at `first` of the list × sign to `received` [N]. keeps: stores the
    /// current visibility in `rows`. Requires that the batch is taken and rendered.
    void receive(const char* stage, const World& world, ProgressiveRadiosity& solver,
                 const ShotList& list, std::uint32_t first, float sign, VisibilityRows& rows,
                 bool keeps, gpu::Array<glm::vec3>& received);

    gpu::Array<std::uint32_t> moved;  ///< [instances] 1: it moves
    gpu::Array<MovedBox> boxes;       ///< bounds of moved instances, before and after

private:
    gpu::Kernel<shaders::IncrementalReceive> receive_;
};

/// Redistributes shot light, batch by batch.
class IncrementalRedistribution {
public:
    /// world: the solver's, made with movers. rows: for the geometry in the world. All must outlive
    /// this.
    IncrementalRedistribution(const gpu::Device& device, World& world, const Lumels& lumels,
                              ProgressiveRadiosity& solver, VisibilityRows& rows);

    /// Starts to correct the solution for a move. Requires !is_under_way(). Returns false if there
    /// is no work: no light was shot yet.
    bool begin(Move move);
    /// Runs one batch. Returns false when finished: the world is then as after the move, and the
    /// solver can continue once the caller has set the near field: set_near_field().
    bool step();
    bool is_under_way() const { return phases_.is_under_way(); }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< total over all moves

private:
    struct Patches3 {
        std::vector<ChosenPatch> unknown, moving, all;
    };

    Patches3 patches_to_shoot();
    void go_after();
    void look();
    void receive(float sign);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows* rows_;
    PairRedistribution pairs_;
    gpu::Kernel<shaders::IncrementalReset> reset_;
    ShotPhases phases_;
    Move move_;
    std::vector<glm::mat4> before_;  ///< [instances] transforms before the move
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
