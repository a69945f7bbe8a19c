#pragma once
// Traces links: the sub-lumels that cosine-distributed rays hit. Each ray is traced once and its
// hit stored; all further bounces use stored links.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/cells/cells.h"
#include "atlas/cells/near_lumels.h"
#include "links/direct/direct.h"
#include "links/trace/shared_directions.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Random streams: shared directions, sub-lumels, direct light, and links of the solutions.
inline constexpr std::uint32_t kSharedStream = 0, kPartStream = 1, kDirectStream = 2,
                               kLinkStream = 3;

/// A link of weight < 1: the ray crossed glass or was reflected on the way.
struct AttenuatedLink {
    std::uint32_t part;
    std::uint32_t weight;  ///< remaining weight, RGB9E5
};

/// Links of some lumels' sub-lumels.
struct LinkBlock {
    std::vector<std::uint32_t> first;       ///< [parts + 1] into target
    std::vector<std::uint32_t> target;      ///< sub-lumels
    std::vector<std::uint32_t> first_weak;  ///< [parts + 1] into weak
    std::vector<AttenuatedLink> weak;
    bool loses = false;  ///< some rays hit no reflecting surface

    template <class Archive>
    void state(Archive& archive)
    {
        archive(first, target, first_weak, weak, loses);
    }
};

/// Lumels per block.
inline constexpr std::size_t kLinkBlock = 256;

/// Links and light gathered in one of several independent solutions.
struct LinkSet {
    explicit LinkSet(std::size_t parts)
        : reflected(parts, glm::vec3(0.0f)),
          sky(parts, glm::vec3(0.0f)),
          rays(parts, 0),
          nearest(parts, std::numeric_limits<float>::max())
    {
    }

    /// True if all rays hit reflecting surfaces.
    bool is_closed() const;
    /// Memory of links [bytes].
    std::size_t bytes() const;

    std::vector<std::vector<LinkBlock>> rounds;  ///< [rounds][blocks]
    std::vector<glm::vec3> reflected;  ///< [P] Σ over rays of direct light at their hits [lx]
    std::vector<glm::vec3> sky;        ///< [P] Σ over rays of sky light [lx]
    std::vector<std::uint32_t> rays;   ///< [P] valid rays
    std::vector<float> nearest;        ///< [P] distance to the nearest hit [m]

    template <class Archive>
    void state(Archive& archive)
    {
        archive(rounds, reflected, sky, rays, nearest);
    }
};

/// Traces rays from lumels until they hit a sub-lumel.
class LinkTracer {
public:
    /// All arguments must outlive this.
    LinkTracer(const LinkWork& work, const SubLumels& parts, const DirectEstimator& direct,
               std::uint32_t seed);

    std::size_t blocks() const { return (work_.order.size() + kLinkBlock - 1) / kLinkBlock; }

    /// Rays to trace.
    struct Sending {
        const std::vector<std::uint16_t>& rays;  ///< [N]; powers of two stratify best
        std::uint32_t stream;                    ///< random stream
        const SharedDirections* shared;          ///< null: every lumel has its own directions
    };
    /// Traces blocks [first, last) into the last round of `into`.
    void trace(std::size_t first, std::size_t last, const Sending& sending, LinkSet& into) const;

private:
    enum class HitKind { part, sky, nothing, lost };
    struct Path;
    struct PathHit;
    struct RayBatch;

    void add(std::uint32_t lumel, const Sending& sending, RayBatch& wave) const;
    void cast_bundles(const SharedDirections& shared, std::vector<RayBatch>& waves) const;
    void follow(RayBatch& wave) const;
    void meet(RayBatch& wave) const;
    void find_seen_cells(RayBatch& wave) const;
    std::optional<RaySpan> ray_to_cell(PathHit& arrival, std::uint32_t seed) const;
    void end_or_reflect(RayBatch& wave) const;
    RaySpan reflect(const RayBatch& wave, const PathHit& arrival, Path& path,
                    ShadowRays& looks) const;
    void keep(const RayBatch& wave, std::size_t lumel, LinkBlock& block, LinkSet& into) const;
    void keep_all(const RayBatch& wave, std::size_t first, LinkSet& into) const;
    void trace_blocks(std::size_t first, std::size_t last, const Sending& sending,
                      LinkSet& into) const;
    void trace_bundles(std::size_t first, std::size_t last, const Sending& sending,
                       LinkSet& into) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    const DirectEstimator& direct_;
    NearLumels hits_;
    std::uint32_t seed_;
    float ray_offset_;
};

}  // namespace lumel
