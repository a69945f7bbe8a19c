#pragma once
// Light straight from its sources, by rays from lumels to points on them.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "lights/shadow_rays.h"
#include "lights/sources.h"
#include "rays/device/bundle_caster.h"

namespace lumel {

/// What rays and lumels of a scene are given by.
struct LinkScene {
    const Scene& scene;
    const Surfaces& surfaces;
    const RayScene& rays;
    const RayCaster& caster;      ///< of the same rays
    const BundleCaster* bundles;  ///< of those that share directions; null: they go the same way
    const Atlas& atlas;
    const Lumels& lumels;
};

/// Direct light of the lumels and, where it varies within one, of its cells.
class DirectEstimator {
public:
    /// What is given must outlive it. Rays go out in the order [N] of lumels.
    DirectEstimator(const LinkScene& place, const LightSources& sources, const RayOrigins& starts,
                    const std::vector<std::uint32_t>& order, std::uint32_t seed);

    /// Of lumels, `varying` of whose light differs from cell to cell.
    static std::uint64_t bytes(std::size_t lumels, std::size_t varying);

    /// Some of the work: true if more is left. First a few rays for each lumel; then many for those
    /// whose light is uncertain.
    bool step();
    /// 0…1
    double fraction() const;
    /// Prepares to add rays where light is uncertain, until its variance has fallen to `share` of
    /// what it is, by `most` rays to one source at most: steps are left again. weight [N]: of the
    /// square of each lumel's error. False, and nothing is left, if no rays would help.
    bool refine(double share, std::uint64_t most, const std::vector<double>& weight);

    /// Two independent estimates [2][N] [lx].
    const std::vector<glm::vec3>& half(int h) const { return half_[h]; }
    /// Mean of both.
    glm::vec3 mean(std::size_t lumel) const { return 0.5f * (half_[0][lumel] + half_[1][lumel]); }
    /// Of one cell, as far as it differs.
    glm::vec3 at(std::size_t lumel, std::uint32_t cell) const
    {
        const std::uint32_t index = varying_[lumel];
        return index == kSame ? mean(lumel) : cells_[index][cell];
    }
    /// Whether it differs from cell to cell.
    bool varies(std::size_t lumel) const { return varying_[lumel] != kSame; }
    /// A point that may be anywhere looks for light, with as many looks as any other such point.
    /// size: of the lumel there.
    void sample_lights(const RayOrigin& start, float size, std::uint32_t seed,
                       ShadowRays& looks) const;
    std::uint32_t looks_around() const;  ///< of one point
    /// The light of a point [lx], by its looks from `first` on once they are cast.
    glm::vec3 light_of(const ShadowRays& looks, std::uint32_t first) const;
    std::uint64_t rays() const { return rays_; }  ///< so far

    /// All that changes, for a StateWriter or a StateReader.
    template <class Archive>
    void state(Archive& archive)
    {
        archive(half_[0], half_[1], taken_, more_, seen_, uncertain_, many_, varying_, cells_,
                blocks_, done_, first_pass_, rays_);
    }
    /// Is what was read of these lumels?
    bool fits() const;

private:
    static constexpr std::uint32_t kSame = ~0u;
    using OfCells = std::array<glm::vec3, kCells>;

    struct Choice;
    struct Found;
    /// A source that rays go to, or several that share them.
    struct RaysTo {
        std::uint32_t source = 0;
        std::uint32_t halved = 0;                  ///< how often its rays are
        const std::vector<float>* rest = nullptr;  ///< running sums of several that share them
    };
    struct Group;
    struct RayBatch;
    struct Block {
        std::vector<std::uint32_t> lumel;
        std::vector<OfCells> cells;
        std::uint64_t rays = 0;

        template <class Archive>
        void state(Archive& archive)
        {
            archive(lumel, cells, rays);
        }
    };

    std::vector<RaysTo> share_out_rays(const glm::vec3& at, float size,
                                       std::vector<float>& rest) const;
    void look(const RayOrigin& start, std::size_t source, float factor, const glm::vec2& at,
              std::uint32_t seed, ShadowRays& looks) const;
    static Choice choose(const std::vector<float>& running, float at);
    void add_rays(std::uint32_t lumel, const RaysTo& to, std::uint32_t more, RayBatch& wave) const;
    void add(std::uint32_t lumel, RayBatch& wave) const;
    static void take(const Group& group, const RayBatch& wave, Found& found);
    void take(const RayBatch& wave);
    void find(const std::vector<std::uint32_t>& lumels, std::size_t first_block,
              std::size_t last_block);
    void keep(std::uint32_t lumel, const Found& found, Block& block);
    double mean_of_all() const;
    bool differs(std::size_t lumel, double mean) const;
    std::uint32_t wanted(std::uint32_t lumel, double rays) const;
    void begin_pass();
    void keep_cells();
    void mark_uncertain_hidden();

    const LinkScene place_;
    const LightSources& sources_;
    const RayOrigins& starts_;
    const std::vector<std::uint32_t>& order_;
    std::uint32_t seed_;
    std::vector<glm::vec3> half_[2];
    std::vector<std::uint32_t> taken_;    ///< [N] rays of one half to a source, beside the few
    std::vector<std::uint32_t> more_;     ///< [N] of them that this pass adds
    std::vector<std::uint32_t> seen_;     ///< [N] bit s: a source of that number mod 32 is seen
    std::vector<char> uncertain_;         ///< [N]
    std::vector<std::uint32_t> many_;     ///< lumels that this pass is for
    std::vector<std::uint32_t> varying_;  ///< [N] index into cells_, or kSame
    std::vector<OfCells> cells_;
    std::vector<Block> blocks_;
    std::size_t done_ = 0;  ///< blocks of this pass
    bool first_pass_ = true;
    std::uint64_t rays_ = 0;
};

}  // namespace lumel
