#pragma once
// Links: what each part of a lumel meets along rays spread by the cosine. Each ray is traced once,
// and the part that it meets is kept; all further bounces go over what is kept.

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

/// A ray that met a part after it had passed glass or had been reflected on its ray.
struct AttenuatedLink {
    std::uint32_t part;
    std::uint32_t weight;  ///< what is left of it, RGB9E5
};

/// Links of the parts of some lumels.
struct LinkBlock {
    std::vector<std::uint32_t> first;       ///< [parts + 1] into target
    std::vector<std::uint32_t> target;      ///< parts
    std::vector<std::uint32_t> first_weak;  ///< [parts + 1] into weak
    std::vector<AttenuatedLink> weak;
    bool loses = false;  ///< some of the rays met no surface that reflects

    template <class Archive>
    void state(Archive& archive)
    {
        archive(first, target, first_weak, weak, loses);
    }
};

/// Lumels of one block.
inline constexpr std::size_t kLinkBlock = 256;

/// What one of two independent sets of rays has found so far.
struct LinkSet {
    explicit LinkSet(std::size_t parts)
        : reflected(parts, glm::vec3(0.0f)),
          sky(parts, glm::vec3(0.0f)),
          rays(parts, 0),
          nearest(parts, std::numeric_limits<float>::max())
    {
    }

    /// Did every ray meet a surface that reflects?
    bool is_closed() const;
    /// That links take.
    std::size_t bytes() const;

    std::vector<std::vector<LinkBlock>> rounds;  ///< [rounds][blocks]
    std::vector<glm::vec3> reflected;  ///< [P] Σ over rays of the direct light that they met [lx]
    std::vector<glm::vec3> sky;        ///< [P] Σ over rays of the sky's light [lx]
    std::vector<std::uint32_t> rays;   ///< [P] that count
    std::vector<float> nearest;        ///< [P] [m] how near they met anything

    template <class Archive>
    void state(Archive& archive)
    {
        archive(rounds, reflected, sky, rays, nearest);
    }
};

/// Follows rays from lumels until they meet a part.
class LinkTracer {
public:
    /// What is given must outlive it. `order` [N]: of lumels, in which blocks take them.
    LinkTracer(const LinkScene& place, const LightSources& sources, const WorldLumels& world,
               const RayOrigins& starts, const Cells& cells, const SubLumels& parts,
               const DirectEstimator& direct, const std::vector<std::uint32_t>& order,
               std::uint32_t seed);

    std::size_t blocks() const { return (order_.size() + kLinkBlock - 1) / kLinkBlock; }

    /// Rays that lumels send out.
    struct Sending {
        const std::vector<std::uint16_t>& rays;  ///< [N]; powers of two stratify best
        std::uint32_t stream;                    ///< of random numbers
        const SharedDirections* shared;          ///< null: every lumel has directions of its own
    };
    /// Traces those of blocks [first, last) into the last round of `into`.
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

    const LinkScene place_;
    const LightSources& sources_;
    const WorldLumels& world_;
    const RayOrigins& starts_;
    const Cells& cells_;
    const SubLumels& parts_;
    const DirectEstimator& direct_;
    const std::vector<std::uint32_t>& order_;
    NearLumels hits_;
    std::uint32_t seed_;
    float ray_offset_;
};

}  // namespace lumel
