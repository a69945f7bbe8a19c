#pragma once
// Traces links: the sub-lumels that cosine-distributed rays hit. Each ray is traced once and its
// hit stored; all light uses stored links.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/cells/cells.h"
#include "atlas/cells/lumel_samples.h"
#include "atlas/cells/near_lumels.h"
#include "links/direct/direct.h"
#include "links/kept/link_changes.h"
#include "links/kept/link_table.h"
#include "links/kept/ray_guide.h"
#include "links/rays/shared_directions.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Random streams: shared directions, sub-lumels, direct light, and links of the solutions.
inline constexpr std::uint32_t kSharedStream = 0, kPartStream = 1, kDirectStream = 2,
                               kLinkStream = 3;
/// Dimension pairs of a ray's origin and direction.
inline constexpr std::uint32_t kOriginPair = 0, kLinkDirectionPair = 1;

/// Traces rays from lumels until they hit a sub-lumel.
class LinkTracer {
public:
    /// All arguments must outlive this. lamps: whose light is kept apart, or null. outside_light:
    /// light is known at lumels only, see LinkRadiosity::reflected().
    LinkTracer(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
               const DirectEstimator& direct, std::uint32_t seed, const LampTable* lamps = nullptr,
               bool outside_light = false);

    std::size_t blocks() const { return (work_.order.size() + kLinkBlock - 1) / kLinkBlock; }

    /// Ends that rays had in an earlier run.
    struct Known {
        const LinkChanges& changes;
        const StoredLinks::Round& round;
        const std::vector<std::size_t>& first_rays;  ///< of the solution, see first_rays()
        std::uint32_t solution;

        /// Ends of a lumel's `rays` rays, or empty if all are to be traced.
        std::span<const LinkEnd> of(std::size_t lumel, std::size_t rays) const;
    };
    /// Rays to trace.
    struct Sending {
        const std::vector<std::uint16_t>& rays;     ///< [N]; powers of two stratify best
        std::uint32_t round, solution;              ///< random numbers differ
        const SharedDirections* shared = nullptr;   ///< null: every lumel has its own directions
        const RayGuide* guide = nullptr;            ///< for later rounds; null: no bins are kept
        std::optional<Known> known = std::nullopt;  ///< traces only what can have changed
    };
    /// Traces blocks [first, last) into the last round of `into`; of several ranks each traces its
    /// own. Rays traced before keep their weights; new ones weigh 1.
    void trace(std::size_t first, std::size_t last, const Sending& sending, LinkTable& into) const;
    /// Weighs the rays of all rounds of a solution, of which the guide drew those after the first.
    /// All have bins. Of several ranks each weighs its own.
    void weigh(const RayGuide& guide, std::uint32_t solution, LinkTable& links) const;
    /// Of the random numbers of a round.
    static std::uint32_t stream(std::uint32_t round, std::uint32_t solution)
    {
        return kLinkStream + std::uint32_t(kSolutions) * round + solution;
    }
    /// Random numbers of the rays that a lumel sends in a round.
    LumelSamples samples_of(std::uint32_t lumel, std::uint32_t round, std::uint32_t solution,
                            std::size_t rays) const;

private:
    struct Landing;
    struct Path;
    struct PathHit;
    struct PathShare;
    struct SkyRay;
    struct RayBatch;

    void weigh_block(std::size_t block, const RayGuide& guide, std::uint32_t solution,
                     LinkTable& links) const;
    void sum_sky(std::uint32_t lumel, std::span<const LinkRow> rows, const RayGuide& guide,
                 std::uint32_t solution, std::vector<glm::vec3>& sky) const;
    void add(std::uint32_t lumel, const Sending& sending, RayBatch& wave) const;
    std::optional<LinkEnd> still(LinkEnd stored, const Known& known) const;
    bool may_meet_moved(const RaySpan& ray, const LinkChanges& changes) const;
    void cast_bundles(const SharedDirections& shared, std::vector<RayBatch>& waves) const;
    void follow(RayBatch& wave) const;
    void find_landings(RayBatch& wave) const;
    Landing landing_of(const RaySpan& ray, const RayHit& hit, std::uint32_t lumel) const;
    void meet_first(RayBatch& wave) const;
    void meet(RayBatch& wave, int reflections) const;
    void add_sky(RayBatch& wave, std::uint32_t path, const RaySpan& ray) const;
    void find_seen_cells(RayBatch& wave, int reflections) const;
    std::optional<RaySpan> ray_to_cell(PathHit& arrival, const CellPoints& points,
                                       std::uint32_t seed) const;
    void end_or_reflect(RayBatch& wave, int reflections) const;
    static float survival(const Path& path, const glm::vec3& albedo, int reflections);
    RaySpan reflect(const RayBatch& wave, const PathHit& arrival, int reflections, Path& path,
                    ShadowRays& looks) const;
    void keep(RayBatch& wave, std::size_t first, LinkTable& into) const;
    void trace_blocks(std::size_t first, std::size_t last, const Sending& sending,
                      LinkTable& into) const;
    void trace_bundles(std::size_t first, std::size_t last, const Sending& sending,
                       LinkTable& into) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    const LinkNumbers stored_;  ///< with lumels in place of sub-lumels
    const DirectEstimator& direct_;
    NearLumels hits_;
    std::uint32_t seed_;
    const LampTable* lamps_;
    bool outside_light_;
    float margin_;  ///< [m] of boxes
};

}  // namespace lumel
