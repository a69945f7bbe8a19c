#pragma once
// A baked scene and an edited one, side by side, in one atlas.

#include <vector>

#include "atlas/prepare/prepare.h"
#include "jobs/edit/changed_light.h"
#include "jobs/edit/matches.h"
#include "jobs/edit/solution_file.h"
#include "results/record/bake_record.h"

namespace lumel {

inline bool is_buried(const Lumel& lumel)
{
    return (lumel.flags & kLumelBuried) != 0;
}

/// Stays where it was made.
struct EditedScene {
    /// before: as read from the bake's scene.glb. Throws Error.
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked);
    /// The same where the bake's atlas is known as it was: then all lumels now are as a bake makes
    /// them, in that atlas. Solution: to tell what changed, as above.
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked,
                const Prepared::LayOut& atlas_before);
    EditedScene(const EditedScene&) = delete;
    EditedScene& operator=(const EditedScene&) = delete;

    Prepared before;
    Matches matches;
    std::vector<Ball> balls;  ///< around what moved
    /// [N now] Open shares of lumels whose pieces are still the whole; 1 of others. Light
    /// gathered at points all over them is this part of that of their open part, as the rest sees
    /// nothing.
    std::vector<float> thinned;
    Prepared now;
    /// [N now] The lumel of the same texel and side before, kNoLumel where there was none that
    /// could be seen.
    std::vector<std::uint32_t> same;
    /// [N now] Of those, the lumels that are also in the same place, as open as they were.
    std::vector<std::uint32_t> partner;

private:
    EditedScene(Scene before, Scene now, const StoredSolution& solution, const BakeRecord& baked,
                const Prepared::LayOut& atlas_before, bool as_a_bake);
    std::vector<float> bury_anew(const Scene& scene, const RayScene& rays,
                                 const StoredSolution& solution, Lumels& lumels);
};

/// Buries the lumels that a bake found buried, as mark_buried() did. Returns their open shares [N].
std::vector<float> bury_as_before(const StoredSolution& solution, Lumels& lumels);

/// Do two lumels reflect and emit alike?
bool looks_alike(const Lumel& a, const Lumel& b);

/// What was done to the scene.
UpdateRow changes_of(const EditedScene& edit);

}  // namespace lumel
