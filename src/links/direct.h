#pragma once
// Light straight from its sources, by rays from lumels to points on them.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "links/sources.h"
#include "nearfield/hit_lumels.h"

namespace lumel {

/// What rays and lumels of a scene are given by.
struct LinkScene {
    const Scene& scene;
    const Surfaces& surfaces;
    const RayScene& rays;
    const Atlas& atlas;
    const Lumels& lumels;
};

/// Direct light of the lumels and, where it varies within one, of its cells.
class DirectFinder {
public:
    /// What is given must outlive it. Rays go out in the order [N] of lumels.
    DirectFinder(const LinkScene& place, const LightSources& sources, const RayStarts& starts,
                 const std::vector<std::uint32_t>& order, std::uint32_t seed);

    /// Some of the work: true if more is left. First a few rays for each lumel; then many for those
    /// whose light is uncertain.
    bool step();
    /// 0…1
    double fraction() const;
    /// Finds the light anew where it is uncertain, by twice as many rays: steps are left again.
    /// False, and nothing is left, if it is uncertain nowhere, or finer than is sensible.
    bool refine();
    /// Rays to one source that refine() would take, at most.
    std::uint64_t rays_to_refine() const;

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
    /// At a point that may be anywhere, by a ray or two [lx]. size: of the lumel there.
    glm::vec3 light_at(const RayStart& start, float size, std::uint32_t seed) const;
    std::uint64_t rays() const { return rays_; }  ///< so far

private:
    static constexpr std::uint32_t kSame = ~0u;
    using OfCells = std::array<glm::vec3, kCells>;

    struct Choice;
    struct Found;
    struct Sums;
    /// A source that rays go to, or several that share them.
    struct RaysTo {
        bool alone = true;
        std::uint32_t source = 0;
        const std::vector<float>* rest = nullptr;  ///< running sums
    };
    struct Seen {
        SourceSample sample;
        glm::vec3 passing{0.0f};  ///< what of it gets through [0…1]
    };
    struct Block {
        std::vector<std::uint32_t> lumel;
        std::vector<OfCells> cells;
        std::uint64_t rays = 0;
    };

    void share_out_rays(const glm::vec3& at, float size, std::vector<std::uint32_t>& own,
                        std::vector<float>& rest) const;
    Seen look(const RayStart& start, std::size_t source, float factor, const glm::vec2& at,
              std::uint32_t seed) const;
    static Choice choose(const std::vector<float>& running, float at);
    void add_rays(std::uint32_t lumel, const RaysTo& to, bool many, Found& found) const;
    Found find(std::uint32_t lumel, bool many) const;
    void keep(std::uint32_t lumel, const Found& found, Block& block);
    double mean_of_all() const;
    bool differs(std::size_t lumel, double mean) const;
    void keep_cells();
    void mark_uncertain_hidden();

    const LinkScene place_;
    const LightSources& sources_;
    const RayStarts& starts_;
    const std::vector<std::uint32_t>& order_;
    std::uint32_t seed_;
    std::uint32_t level_ = 0;  ///< many rays are 2^level times as many
    std::vector<glm::vec3> half_[2];
    std::vector<std::uint32_t> seen_;     ///< [N] bit s: a source of that number mod 32 is seen
    std::vector<char> uncertain_;         ///< [N]
    std::vector<std::uint32_t> many_;     ///< lumels that many rays are for
    std::vector<std::uint32_t> varying_;  ///< [N] index into cells_, or kSame
    std::vector<OfCells> cells_;
    std::vector<Block> blocks_;
    std::size_t done_ = 0;  ///< blocks of this pass
    bool first_pass_ = true;
    std::uint64_t rays_ = 0;
};

}  // namespace lumel
