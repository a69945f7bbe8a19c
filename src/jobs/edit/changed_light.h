#pragma once
// The change of the light that arrives at lumels where something moved, came or went.

#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/packing/atlas.h"
#include "jobs/edit/matches.h"
#include "jobs/edit/two_estimates.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// A ball that contains an object that moved, where it was or where it is.
struct Ball {
    glm::vec3 centre;  ///< [m]
    float radius;      ///< [m]
};

/// What lumels of a scene send, E + reflected.
struct SentLight {
    std::vector<glm::vec3> emission;   ///< [N] E [lm/m²]
    std::vector<glm::vec3> reflected;  ///< [N] ρH [lm/m²]
};

/// A scene as rays see it. All it names must outlive it, unmoved.
struct SeenScene {
    const Scene* scene;
    const RayScene* rays;
    const Lumels* lumels;
    const HitLumels* hits;
    SentLight sent;
};

/// What is to be found for a lumel.
enum class Wanted : std::uint8_t {
    nothing,     ///< it is buried
    difference,  ///< light that arrives now, less light that arrived before
    all,         ///< all light that arrives now
};

struct ChangedLightOptions {
    float fineness = 0.012f;    ///< error of a lumel's light aimed at, as a part of what it faces
    std::uint32_t whole = 128;  ///< rays of a lumel whose whole light is found
    std::uint32_t lamps = 32;   ///< points of lamps for each lumel
    std::uint32_t effort = 1;   ///< factor for the numbers of rays and points
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

struct ChangedLight {
    TwoEstimates irradiance;  ///< [N] [lx]
    std::uint64_t rays = 0;   ///< followed for it
};

/// Of the lumels `now`. Light that comes straight from the sky and lamps of `before` counts, in
/// both scenes; the lights of `now` are not used. partner [N]: the same lumel before, kNoLumel:
/// none or changed. Noise is in proportion to what changed: where nothing did the difference is 0.
ChangedLight gather_changed_light(const SeenScene& before, const SeenScene& now,
                                  const std::vector<std::uint32_t>& partner,
                                  const std::vector<Wanted>& wanted, const std::vector<Ball>& balls,
                                  const ChangedLightOptions& options,
                                  const std::function<void(double)>& progress = {});

/// Around what moved, in both places, what is new and what is gone. Few, by joining them if need
/// be.
std::vector<Ball> changed_balls(const Scene& before, const Scene& now, const Matches& matches);

}  // namespace lumel
