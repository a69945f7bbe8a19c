#pragma once
// A baked scene and its edited version in one atlas.

#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/edit/changed_light.h"
#include "jobs/edit/matches.h"
#include "jobs/edit/solution_file.h"
#include "results/record/bake_record.h"

namespace lumel {

inline bool is_buried(const Lumel& lumel)
{
    return (lumel.flags & kLumelBuried) != 0;
}

/// Must not move.
struct EditedScene {
    /// before: as read from the bake's scene.glb. Throws Error.
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked);
    /// For a known original atlas: all lumels `now` are then as a bake makes them in that atlas.
    /// solution: to detect changes, as above.
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked,
                const SolveScene::LayOut& atlas_before);
    EditedScene(const EditedScene&) = delete;
    EditedScene& operator=(const EditedScene&) = delete;

    SolveScene before;
    Matches matches;
    std::vector<Ball> balls;  ///< bounding spheres of moved objects
    /// [N now] Open fractions of lumels whose pieces still cover the whole; 1 for others. Light
    /// gathered over all of such a lumel is this fraction of that of its open part, as the rest
    /// receives none.
    std::vector<float> thinned;
    SolveScene now;
    /// [N now] The visible lumel of the same texel and side before, else kNoLumel.
    std::vector<std::uint32_t> same;
    /// [N now] Lumel before with unchanged position and open area, else kNoLumel.
    std::vector<std::uint32_t> partner;

private:
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked,
                const SolveScene::LayOut& atlas_before, bool as_a_bake);
    std::vector<float> bury_anew(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                                 const StoredSolution& solution, Lumels& lumels);
};

/// Buries the lumels that the bake buried, as mark_buried() did. Returns their open fractions [N].
std::vector<float> bury_as_before(const StoredSolution& solution, Lumels& lumels);

/// True if two lumels have equal reflectance and emission.
bool looks_alike(const Lumel& a, const Lumel& b);

/// Counts of the scene's changes.
UpdateRow changes_of(const EditedScene& edit);

}  // namespace lumel
