#pragma once
// Rays that LinkTracer traces together.

#include <cstdint>
#include <vector>

#include "links/rays/tracer.h"

namespace lumel {

/// Dimension pairs of a ray's random numbers; each reflection uses kPerReflection more.
inline constexpr std::uint32_t kPassPair = 2, kFirstReflection = 3, kPerReflection = 3;

/// Hits closer than this many sides can be on a sliver that the lumel's cells do not represent, as
/// in a gap between two walls: light is looked up in a cell visible from the hit, or not at all.
inline constexpr float kMayBeHidden = 1.0f;

/// Result of a ray: the lumel it hits, or the number of its end.
struct LinkTracer::Landing {
    std::uint32_t lumel = kNoLumel;
    std::uint32_t end = 0;  ///< number, without a lumel
    std::uint32_t cell = 0;
    float size = 0.0f;  ///< of the lumel [m]
    glm::vec3 position{0.0f};
};

/// A ray that needs more than its first hit: one near its lumel, behind glass, or on a lumel that
/// is cut, half covered or has hidden points.
struct LinkTracer::Path {
    PathSamples samples;
    std::uint32_t slot;
    float size;               ///< size of the last lumel on the path [m]
    glm::vec3 weight;         ///< that remains
    float distance;           ///< to the first hit [m], or NearLight::kNoHit
    LinkEnd end;              ///< once it ended
    glm::vec3 light{0.0f};    ///< gathered [lx]
    bool is_straight = true;  ///< not reflected
};

/// A path's hit on a lumel.
struct LinkTracer::PathHit {
    std::uint32_t ray;  ///< of the batch
    std::uint32_t path;
    std::uint32_t lumel, cell;
    glm::vec3 position;              ///< [m]
    bool may_be_hidden;              ///< the hit may be occluded from the lumel's cells
    bool looks_around;               ///< traces shadow rays instead of using a cell
    bool goes_on;                    ///< is reflected there
    bool is_hidden = false;          ///< no cell is visible
    std::uint32_t unseen_cells = 0;  ///< bit c: cell c was tested, and is occluded
};

/// A part of a path's light, as in NearShare.
struct LinkTracer::PathShare {
    std::uint32_t path;
    std::uint32_t lamp;
    LinkEnd at;
    glm::vec3 light;
};

/// Light of the sky along a ray.
struct LinkTracer::SkyRay {
    std::uint32_t slot;
    glm::vec3 light;  ///< [lx]
};

/// Rays traced together, and their paths, one reflection at a time.
struct LinkTracer::RayBatch {
    // Results, in slots of the batch.
    std::vector<std::uint32_t> lumels;
    std::vector<LumelSamples> samples;        ///< [lumels] of their rays
    std::vector<std::uint32_t> slots_before;  ///< [lumels + 1]
    std::vector<LinkEnd> ends;                ///< [slots]
    std::vector<std::uint8_t> from;           ///< [slots] cells that the rays leave
    std::vector<std::uint8_t> bins;           ///< [slots] of directions that may be guided
    std::vector<SkyRay> sky;
    std::vector<Path> paths;        ///< by slot
    std::vector<PathShare> shares;  ///< of paths; empty unless lamps are kept apart

    // Rays that have not ended.
    std::vector<RaySpan> rays;
    std::vector<std::uint32_t> of;     ///< [rays] slots of first rays, paths of later ones
    std::vector<RayHit> hits;          ///< [rays or more]
    std::vector<std::uint32_t> along;  ///< [rays] shared direction, for first rays
    bool is_cast = false;              ///< hits of first rays are known
    std::vector<std::uint32_t> met;    ///< [rays] lumels
    std::vector<Landing> landings;     ///< [rays]
    std::uint32_t first_rays = 0;
    std::vector<PathHit> arrivals;

    // One reflection; members to reuse their memory.
    std::vector<std::uint32_t> open;  ///< hits that need a visible cell
    std::vector<RaySpan> to_cells;
    std::vector<glm::vec3> transmittance;  ///< [to_cells]
    ShadowRays looks;
    std::vector<RaySpan> next_rays;
    std::vector<std::uint32_t> next_of;  ///< [next_rays]
    std::vector<std::uint32_t> looking;  ///< paths with shadow rays

    RayBatch() { begin(); }
    void begin()
    {
        lumels.clear();
        samples.clear();
        slots_before.assign(1, 0);
        ends.clear();
        from.clear();
        bins.clear();
        sky.clear();
        paths.clear();
        shares.clear();
        rays.clear();
        of.clear();
        along.clear();
    }
};

}  // namespace lumel
