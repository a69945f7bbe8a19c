#pragma once
// Less noise in what is shown: weights by which lumels mix with those around them, kept while the
// light changes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

struct FilterTile;

/// The narrow filter of charts (links/filter/filter_tile.h): two lumels to either side. Its weights
/// come from light that was at rest once, and serve what follows. Lumels of which it has none are
/// shown as they are.
class DisplayFilter {
public:
    /// What is given must outlive it.
    DisplayFilter(const LinkContext& place, const LumelLinks& links);

    /// Light by rays is that of the links and sweeps now, and of the sky, times a factor: makes all
    /// weights anew in the steps that follow.
    void begin(const LumelSweeps& sweeps, const glm::vec3& sky);
    /// The same for light of which these are independent halves [2][N] [lx].
    void begin(std::array<std::vector<glm::vec3>, 2> halves);
    /// A piece of that. True when all is done.
    bool step();

    /// H at a lumel [lx]: direct light, which is sharp, as it is, and light by rays filtered. sky:
    /// what of its light the sweeps began with [N] [lx]; empty: none.
    glm::vec3 irradiance(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                         std::size_t lumel) const;
    /// The part of it that rays bring.
    glm::vec3 filtered(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                       std::size_t lumel) const;
    /// Any light [N] by the weights.
    glm::vec3 filtered(std::span<const glm::vec3> light, std::size_t lumel) const;
    /// Of the light that is shown, by its size: the root of the mean square over channels of what
    /// is expected to be wrong, for the noise of rays alone. 1 of lumels that have no weights yet,
    /// 0 of buried ones, which no one sees.
    float noise(const LumelSweeps& sweeps, std::span<const glm::vec3> sky, std::size_t lumel) const;
    std::uint64_t bytes() const;

private:
    struct Weight {
        std::uint32_t lumel;
        float weight;  ///< beside 1 of its own
    };
    /// A tile of one side of the atlas.
    struct Tile {
        int left = 0, top = 0, side = 0;
        std::vector<std::uint32_t> first;  ///< [lumels + 1] into weights
        std::vector<Weight> weights;
    };
    struct Place {
        std::uint32_t tile = ~0u, number = 0;
    };

    std::uint32_t lumel_at(int x, int y, int side) const;
    float nearest_of(std::size_t lumel) const;
    std::uint8_t steps_of(std::size_t lumel) const;
    bool may_step(std::size_t i, std::size_t j) const;
    void find_halves(std::size_t lumel);
    void find_nearest(std::size_t lumel);
    void fill(const Tile& of, FilterTile& tile) const;
    void find_noise(FilterTile& tile);
    void weigh(Tile& of, FilterTile& tile);
    template <class Light>
    glm::vec3 mixed(const Light& light, std::size_t lumel) const;
    float noise_left(std::uint32_t lumel, const Tile& of) const;
    template <class Work>
    bool do_tiles(const Work& work);

    const LinkContext place_;
    const LumelLinks& links_;
    const LumelSweeps* sweeps_ = nullptr;  ///< that weights are made for
    glm::vec3 sky_{0.0f};
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
    std::vector<Tile> tiles_;
    std::vector<Place> places_;      ///< [N]
    std::vector<float> noise_left_;  ///< [N] of light by rays when weights were made, by its size
    enum class Stage { halves, nearest, steps, noise, weights, done } stage_ = Stage::done;
    std::size_t next_ = 0;  ///< lumel or tile of the stage
    // Light by rays from every other direction, and by the others: empty when done.
    std::array<std::vector<glm::vec3>, 2> halves_;  ///< [N] [lx]
    std::vector<float> nearest_, noise_;            ///< [N] [m], and the variance of a half
    std::vector<std::uint8_t> steps_;               ///< [N] bit s: light may mix over kSteps[s]
};

}  // namespace lumel
