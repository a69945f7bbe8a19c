#pragma once
// The table of links: what each ray of the lumels hit. It depends on geometry alone, except for the
// light of rays that are reflected close to their lumel.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/cells/cells.h"
#include "links/kept/near_weight.shared.h"

namespace lumel {

struct LinkWork;

/// End of a ray: the number of what it hit, and the hit cell of a lumel.
struct LinkEnd {
    static constexpr std::uint32_t kCellBits = 4, kMaxNumber = (1u << (32 - kCellBits)) - 1;
    static_assert(kCells == 1 << kCellBits);

    std::uint32_t bits = 0;

    static LinkEnd of(std::uint32_t number, std::uint32_t cell = 0)
    {
        return {number << kCellBits | cell};
    }
    std::uint32_t number() const { return bits >> kCellBits; }
    std::uint32_t cell() const { return bits & (kCells - 1); }

    friend bool operator==(const LinkEnd&, const LinkEnd&) = default;
};

/// Numbers of ends: some fixed ones, then two of each instance, then sub-lumels.
class LinkNumbers {
public:
    static constexpr std::uint32_t kBelow = 0;  ///< left below its own surface: black
    static constexpr std::uint32_t kSky = 1;
    static constexpr std::uint32_t kNear = 2;  ///< the NearLink of this ray has the end

    /// Throws Error{input} unless they fit.
    LinkNumbers(std::size_t instances, std::size_t parts);

    static bool fit(std::size_t instances, std::size_t parts)
    {
        return kFirst + 2 * instances + parts < LinkEnd::kMaxNumber;
    }
    /// Absorbed by the back of a single-sided surface.
    std::uint32_t black_on(std::uint32_t instance) const { return kFirst + 2 * instance; }
    /// Hit an instance where it has no lumel: the ray does not count.
    std::uint32_t lost_on(std::uint32_t instance) const { return kFirst + 2 * instance + 1; }
    std::uint32_t of_part(std::uint32_t part) const { return first_part_ + part; }

    bool is_part(std::uint32_t number) const { return number >= first_part_; }
    bool is_lost(std::uint32_t number) const
    {
        return number >= kFirst && number < first_part_ && (number - kFirst) % 2 == 1;
    }
    std::uint32_t part(std::uint32_t number) const { return number - first_part_; }
    std::uint32_t count() const { return count_; }

private:
    static constexpr std::uint32_t kFirst = 3;
    std::uint32_t first_part_, count_;
};

/// A first hit closer than this many sides of the larger lumel is reflected: near corners indirect
/// light changes within a lumel, but is stored per sub-lumel only.
inline constexpr float kNearSides = 2.0f;

/// A ray whose first hit is near or on a half-covered lumel, or that crossed glass.
struct NearLink {
    std::uint32_t slot;  ///< index of the ray in its block
    LinkEnd end;
    std::uint32_t packed_weight;  ///< remaining weight, RGB9E5

    glm::vec3 weight() const { return near_weight(packed_weight); }
};

/// The part of a near link that sweeps do not read.
struct NearLight {
    static constexpr float kNoHit = std::numeric_limits<float>::max();

    float distance;   ///< to the first hit [m], or kNoHit
    glm::vec3 light;  ///< gathered on the way and at the end, without further bounces [lx]
};

/// A part of NearLight::light, kept where the light of lamps is kept apart.
struct NearShare {
    static constexpr std::uint32_t kEveryLamp = ~0u;

    std::uint32_t near;  ///< index of the NearLink in its block
    std::uint32_t lamp;  ///< whose `light` it is; kEveryLamp: light is the factor on that of `at`
    LinkEnd at;
    glm::vec3 light;
};

/// Links of up to kLinkBlock lumels. A slot is a ray.
struct LinkBlock {
    std::vector<std::uint16_t> rays;    ///< [lumels]
    std::vector<LinkEnd> ends;          ///< [slots]
    std::vector<std::uint8_t> from;     ///< cells that rays of lumels with hidden points leave
    std::vector<NearLink> near;         ///< by slot
    std::vector<NearLight> near_light;  ///< of these
    std::vector<NearShare> shares;      ///< by near link; empty unless lamps are kept apart
    std::vector<std::uint8_t> bins;     ///< [slots] of RayGuide; empty unless rays may be guided
    std::vector<float> weights;         ///< [slots] of rays, see RayGuide; empty: all are 1
    std::uint64_t traced = 0;           ///< rays; the ends of others were known

    template <class Archive>
    void state(Archive& archive)
    {
        archive(rays, ends, from, near, near_light, shares, bins, weights, traced);
    }
};

/// Lumels per block.
inline constexpr std::size_t kLinkBlock = 256;

/// Links of one lumel in one round.
struct LinkRow {
    std::uint32_t first_slot;
    std::span<const LinkEnd> ends;
    const std::uint8_t* from;  ///< [ends] cells or kNoCell; null: the lumel has no hidden points
    std::span<const NearLink> near;
    std::span<const NearLight> near_light;  ///< of these
    std::span<const NearShare> shares;      ///< of these
    std::uint32_t first_near;               ///< index of the first in its block
    const float* weights;                   ///< [ends] or null: all are 1

    /// Weight of ray k, as which its light counts; 1 on average.
    float weight(std::size_t k) const { return weights ? weights[k] : 1.0f; }

    /// Number of the sub-lumel, in its lumel, that ray k leaves.
    std::uint32_t leaves(const SubLumels& parts, std::size_t lumel, std::size_t k) const
    {
        return from ? parts.part(lumel, from[k]) - parts.first(lumel) : 0;
    }
};

/// Iterates over the rows of a block.
class LinkRows {
public:
    explicit LinkRows(const LinkBlock& block) : block_(&block) {}

    LinkRow next(bool has_hidden)
    {
        const std::size_t rays = block_->rays[lumel_++];
        LinkRow row{.first_slot = slot_,
                    .ends = {block_->ends.data() + slot_, rays},
                    .from = nullptr,
                    .near = {},
                    .near_light = {},
                    .shares = {},
                    .first_near = near_,
                    .weights = nullptr};
        if (!block_->weights.empty())
            row.weights = block_->weights.data() + slot_;
        if (has_hidden) {
            row.from = block_->from.data() + from_;
            from_ += std::uint32_t(rays);
        }
        slot_ += std::uint32_t(rays);
        const std::uint32_t first = near_;
        while (near_ < block_->near.size() && block_->near[near_].slot < slot_)
            ++near_;
        row.near = {block_->near.data() + first, near_ - first};
        row.near_light = {block_->near_light.data() + first, near_ - first};
        const std::uint32_t first_share = share_;
        while (share_ < block_->shares.size() && block_->shares[share_].near < near_)
            ++share_;
        row.shares = {block_->shares.data() + first_share, share_ - first_share};
        return row;
    }

private:
    const LinkBlock* block_;
    std::uint32_t lumel_ = 0, slot_ = 0, from_ = 0, near_ = 0, share_ = 0;
};

/// Links of one of several independent solutions. Of several ranks, each has those of its blocks;
/// others are empty.
struct LinkTable {
    explicit LinkTable(std::size_t parts) : sky(parts, glm::vec3(0.0f)) {}

    std::vector<std::vector<LinkBlock>> rounds;  ///< [rounds][blocks]
    std::vector<glm::vec3> sky;  ///< [P] Σ over rays that meet the sky of its light [lx]

    /// Memory of links [bytes].
    std::size_t bytes() const;
    /// True if all indices are valid: of lumels in the order of work, of sub-lumels and of numbers.
    /// traced: blocks of the last round that are not empty, of this rank's. lamps: kept apart.
    /// has_bins: of all rays.
    bool fits(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
              std::size_t traced, std::size_t lamps, bool has_bins) const;
};

}  // namespace lumel
