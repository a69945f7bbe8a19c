#pragma once
// Change of the light at lumels where objects moved, appeared or vanished.

#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "jobs/edit/matches.h"
#include "jobs/edit/two_estimates.h"

namespace lumel {

/// Bounding sphere of a moved object, at its old or new position.
struct Ball {
    glm::vec3 centre;  ///< [m]
    float radius;      ///< [m]
};

/// Light from the lumels of a scene, E + reflected.
struct SentLight {
    std::vector<glm::vec3> emission;   ///< [N] E [lm/m²]
    std::vector<glm::vec3> reflected;  ///< [N] ρH [lm/m²]
};

/// A scene with its light. The pointers must outlive it.
struct SeenScene {
    const SolveScene* scene;
    const HitLumels* hits;
    SentLight sent;
};

/// Light to gather at a lumel.
enum class Wanted : std::uint8_t {
    nothing,     ///< none: it is buried
    difference,  ///< light now minus light before
    all,         ///< all light now
};

struct ChangedLightOptions {
    float fineness = 0.012f;    ///< target error of a lumel's light, relative to its surroundings
    std::uint32_t whole = 128;  ///< rays per lumel with Wanted::all
    std::uint32_t lamps = 32;   ///< points on lamps per lumel
    std::uint32_t effort = 1;   ///< multiplies the numbers of rays and points
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

struct ChangedLight {
    TwoEstimates irradiance;  ///< [N] [lx]
    std::uint64_t rays = 0;   ///< traced
};

/// Light at the lumels `now`. Direct light of the sky and lamps of `before` counts in both scenes;
/// lights of `now` are not used. partner [N]: the same lumel before, kNoLumel: none or changed.
/// Noise is proportional to the change: without a change the difference is 0.
ChangedLight gather_changed_light(const SeenScene& before, const SeenScene& now,
                                  const std::vector<std::uint32_t>& partner,
                                  const std::vector<Wanted>& wanted, const std::vector<Ball>& balls,
                                  const ChangedLightOptions& options,
                                  const std::function<void(double)>& progress = {});

/// Bounding spheres of moved objects in both positions, and of new and removed ones, merged if
/// there are many.
std::vector<Ball> changed_balls(const Scene& before, const Scene& now, const Matches& matches);

}  // namespace lumel
