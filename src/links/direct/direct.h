#pragma once
// Direct light: shadow rays from lumels to emissive surfaces, lamps, suns and the bright sky.
//
// 1. Every lumel sends a few rays to each strong source. Weak sources share rays.
// 2. Lumels that see part of a source, whose halves differ, or whose neighbours see other sources
//    start over with many rays. Discarding the first estimate keeps the result unbiased.
// 3. refine() adds rays where the variance is largest.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lights/lamps.h"
#include "lights/shadow_rays.h"
#include "links/direct/link_work.h"

namespace lumel {

/// Estimates direct irradiance [lx] in two independent halves, whose difference gives the variance.
/// Lumels in which it varies also store it per cell. Call step() until it returns false, then read
/// half(), mean() and at(). If refine() returns true, call step() again.
class DirectEstimator {
public:
    /// The work must outlive this. parts: sub-lumels, across which no light passes, or null. lamps:
    /// if not null, light is also stored per lamp, by the same shadow rays.
    DirectEstimator(const LinkWork& work, std::uint32_t seed, const SubLumels* parts = nullptr,
                    const LampTable* lamps = nullptr);

    /// Memory [bytes]. varying: number of lumels stored per cell; of lamps, which are kept apart:
    /// varying_by_lamp.
    static std::uint64_t bytes(std::size_t lumels, std::size_t varying, std::size_t lamps,
                               std::size_t varying_by_lamp);

    /// Runs part of a pass. Returns true if work is left.
    bool step();
    /// Progress, 0…1.
    double fraction() const;
    /// Schedules another pass where the variance is largest. It aims at `share` × the present
    /// variance, with at most `most` rays per source in total. weight [N]: of each lumel's squared
    /// error. Returns false if such a pass would gain less than 10 %.
    bool refine(double share, std::uint64_t most, const std::vector<double>& weight);
    /// [N] Of the scheduled pass: 0 for lumels without new rays, else 1 + log2(rays after it /
    /// kManyRays), at most kMaxLevel.
    std::vector<std::uint8_t> levels() const;
    /// Schedules a pass by its levels() in a former bake. Returns false if no lumel gains rays.
    bool refine_to(const std::vector<std::uint8_t>& levels);
    static constexpr std::uint8_t kMaxLevel = 14;  ///< of kMaxShadowRays

    /// Two independent estimates [2][N] [lx].
    const std::vector<glm::vec3>& half(int h) const { return half_[h]; }
    /// Mean of both halves [lx].
    glm::vec3 mean(std::size_t lumel) const { return 0.5f * (half_[0][lumel] + half_[1][lumel]); }
    /// Direct light of a cell: the lumel's mean unless it varies [lx].
    glm::vec3 at(std::size_t lumel, std::uint32_t cell) const
    {
        return varies(lumel) ? by_cell_.of(lumel)[cell] : mean(lumel);
    }
    /// Mean of both halves [lx] of the light of one lamp; the lamps' sum is mean().
    glm::vec3 mean_of_lamp(std::size_t lumel, std::size_t lamp) const
    {
        const std::size_t at = lumel * lamps_ + lamp;
        return 0.5f * (lamp_half_[0][at] + lamp_half_[1][at]);
    }
    /// Difference of the halves [lx] of the light of one lamp.
    glm::vec3 lamp_apart(std::size_t lumel, std::size_t lamp) const
    {
        const std::size_t at = lumel * lamps_ + lamp;
        return lamp_half_[0][at] - lamp_half_[1][at];
    }
    /// at() of each lamp [lamps]. Requires that their light is stored per cell.
    const glm::vec3* lamps_in(std::size_t lumel, std::uint32_t cell) const
    {
        return lamps_by_cell_.of(lumel) + cell * lamps_;
    }
    /// True if direct light is stored per cell.
    bool varies(std::size_t lumel) const { return by_cell_.index[lumel] != kSame; }
    /// Index of a lumel that varies among those, for light_in().
    std::uint32_t index_of_cells(std::size_t lumel) const { return by_cell_.index[lumel]; }
    /// at() of a cell, by that index.
    const glm::vec3& light_in(std::uint32_t index, std::uint32_t cell) const
    {
        return by_cell_.cells[std::size_t(index) * kCells + cell];
    }
    /// True if the light of lamps is: also where only their sum is even.
    bool varies_by_lamp(std::size_t lumel) const { return lamps_by_cell_.index[lumel] != kSame; }
    /// Queues looks_around() shadow rays from any point of the scene. size: of the lumel there [m].
    void sample_lights(const RayOrigin& start, float size, std::uint32_t seed,
                       ShadowRays& looks) const;
    std::uint32_t looks_around() const;  ///< shadow rays per point
    /// Direct light [lx] of a point whose shadow rays begin at `first`. Requires that they are
    /// cast.
    glm::vec3 light_of(const ShadowRays& looks, std::uint32_t first) const;
    std::uint64_t rays() const { return rays_; }  ///< total

    /// Complete changing state, for a StateWriter or a StateReader.
    template <class Archive>
    void state(Archive& archive)
    {
        archive(half_[0], half_[1], taken_, more_, seen_, uncertain_, many_, by_cell_, blocks_,
                done_, first_pass_, rays_, lamp_half_[0], lamp_half_[1], lamps_by_cell_);
    }
    /// True if the state that was read has the right sizes.
    bool fits() const;

private:
    static constexpr std::uint32_t kSame = ~0u;
    static constexpr std::size_t kBlock = 256;  ///< lumels that are processed together
    /// Rays of one half per source: of all lumels, and of those that see part of a source.
    static constexpr std::uint32_t kFewRays = 8, kManyRays = 16;
    /// Maximum rays of one half to a source, and maximum growth per pass.
    static constexpr std::uint32_t kMaxShadowRays = kManyRays << (kMaxLevel - 1), kMaxTimes = 16;
    using OfCells = std::array<glm::vec3, kCells>;

    struct Choice;
    struct OfLumel;
    struct Found;
    /// A source with its own rays, or several that share rays.
    struct RaysTo {
        std::uint32_t source = 0;
        std::uint32_t halved = 0;                  ///< number of times that its rays are halved
        const std::vector<float>* rest = nullptr;  ///< cumulative weights of sharing sources
    };
    struct Group;
    struct RayBatch;
    /// Light by cell of the lumels in which it varies, of one or more kinds of light.
    struct ByCell {
        std::size_t kinds;
        std::vector<std::uint32_t> index;  ///< [N] its place in `cells`, or kSame
        std::vector<glm::vec3> cells;      ///< [places][kCells][kinds]

        std::size_t size() const { return kCells * kinds; }  ///< of a place
        const glm::vec3* of(std::size_t lumel) const { return &cells[index[lumel] * size()]; }
        bool fits(std::size_t lumels) const;
        template <class Archive>
        void state(Archive& archive)
        {
            archive(index, cells);
        }
    };
    /// Light by cell that a pass found in some lumels.
    struct FoundCells {
        std::vector<std::uint32_t> lumel;
        std::vector<glm::vec3> cells;  ///< [lumels][kCells][kinds]

        bool fits(std::size_t lumels, std::size_t kinds) const;
        template <class Archive>
        void state(Archive& archive)
        {
            archive(lumel, cells);
        }
    };
    struct Block {
        FoundCells light, of_lamps;
        std::uint64_t rays = 0;

        template <class Archive>
        void state(Archive& archive)
        {
            archive(light, of_lamps, rays);
        }
    };

    std::vector<RaysTo> share_out_rays(const Receiver& receiver, std::vector<float>& rest) const;
    void look(const RayOrigin& start, std::size_t source, float factor, const glm::vec2& at,
              std::uint32_t seed, ShadowRays& looks) const;
    static Choice choose(const std::vector<float>& running, float at);
    void add_rays(std::uint32_t lumel, const RaysTo& to, std::uint32_t more, const SeenCells* seen,
                  RayBatch& wave) const;
    bool is_cut(std::uint32_t lumel) const { return parts_ && parts_->is_cut(lumel); }
    /// Number of a cell's sub-lumel in its lumel.
    std::uint32_t part_of(std::uint32_t lumel, std::uint32_t cell) const
    {
        return is_cut(lumel) ? parts_->part(lumel, cell) - parts_->first(lumel) : 0u;
    }
    void add(std::uint32_t lumel, RayBatch& wave) const;
    void take(const Group& group, std::uint32_t lumel, const RayBatch& wave, Found& found) const;
    void share_out(const Group& group, std::uint32_t lumel, const RayBatch& wave,
                   const OfLumel& light, Found& found) const;
    void take(const RayBatch& wave);
    void find(const std::vector<std::uint32_t>& lumels, std::size_t first_block,
              std::size_t last_block);
    static bool differ(const OfCells& cells);
    void keep_by_cell(std::uint32_t lumel, const Found& found, float before, Block& block) const;
    void keep(std::uint32_t lumel, const Found& found, Block& block);
    void share(const std::vector<std::uint32_t>& lumels, std::size_t first_block,
               std::size_t last_block);
    double mean_of_all() const;
    bool differs(std::size_t lumel, double mean) const;
    std::uint32_t wanted(std::uint32_t lumel, double rays) const;
    bool begin_pass_of_many();
    void begin_pass();
    void keep_cells();
    template <class Keeps>
    void renew(ByCell& kept, FoundCells Block::*found, const Keeps& keeps) const;
    void mark_uncertain_hidden();

    const LinkWork& work_;
    std::uint32_t seed_;
    const SubLumels* parts_;
    const LampTable* of_lamps_;  ///< null: light of lamps is not kept apart
    const std::size_t lamps_;
    std::vector<glm::vec3> half_[2];
    std::vector<glm::vec3> lamp_half_[2];  ///< [N][lamps]
    std::vector<std::uint32_t> taken_;     ///< [N] rays of one half per source in later passes
    std::vector<std::uint32_t> more_;      ///< [N] rays that this pass adds
    std::vector<std::uint32_t> seen_;      ///< [N] bit s: a source ≡ s (mod 32) is visible
    std::vector<char> uncertain_;          ///< [N]
    std::vector<std::uint32_t> many_;      ///< lumels of this pass
    ByCell by_cell_, lamps_by_cell_;
    std::vector<Block> blocks_;
    std::size_t done_ = 0;  ///< blocks of this pass
    bool first_pass_ = true;
    std::uint64_t rays_ = 0;
};

}  // namespace lumel
