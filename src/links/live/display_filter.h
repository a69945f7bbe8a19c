#pragma once
// Filter weights for displayed light, reused while the light changes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

struct FilterTile;

/// The narrow chart filter (links/live/filter_tile.h) of radius 2. Its weights come from light
/// that had converged, and are reused for later light. Lumels without weights are shown unfiltered.
class DisplayFilter {
public:
    /// All arguments must outlive this.
    DisplayFilter(const LinkContext& place, const LumelLinks& links);

    /// Schedules new weights for the current links, sweeps and sky light times `sky`. Call step()
    /// next.
    void begin(const LumelSweeps& sweeps, const glm::vec3& sky);
    /// Runs a piece of that work. Returns true when all is done.
    bool step();

    /// Irradiance at a lumel [lx]: direct light unfiltered, light by rays filtered. sky: [N] sky
    /// light that the sweeps began with [lx]; empty: none.
    glm::vec3 irradiance(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                         std::size_t lumel) const;
    /// Its part by rays.
    glm::vec3 filtered(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                       std::size_t lumel) const;
    /// Expected error of the displayed light from ray noise, as RMS over channels relative to the
    /// light. 1 for lumels without weights, 0 for buried ones.
    float noise(const LumelSweeps& sweeps, std::span<const glm::vec3> sky, std::size_t lumel) const;
    std::uint64_t bytes() const;

private:
    struct Weight {
        std::uint32_t lumel;
        float weight;  ///< relative to 1 for the lumel itself
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

    std::uint8_t steps_of(std::size_t lumel) const;
    bool may_step(std::size_t i, std::size_t j) const;
    void find_halves(std::size_t lumel);
    void find_nearest(std::size_t lumel);
    void fill(const Tile& of, FilterTile& tile) const;
    void find_noise(FilterTile& tile);
    void weigh(Tile& of, FilterTile& tile);
    float noise_left(std::uint32_t lumel, const Tile& of) const;
    template <class Work>
    bool do_tiles(const Work& work);

    const LinkContext place_;
    const LumelLinks& links_;
    const LumelSweeps* sweeps_ = nullptr;  ///< for which weights are made
    glm::vec3 sky_{0.0f};
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
    std::vector<Tile> tiles_;
    std::vector<Place> places_;      ///< [N]
    std::vector<float> noise_left_;  ///< [N] relative noise of light by rays when weights were made
    enum class Stage { halves, nearest, steps, noise, weights, done } stage_ = Stage::done;
    std::size_t next_ = 0;  ///< lumel or tile of the stage
    std::array<std::vector<glm::vec3>, 2>
        halves_;                          ///< [N] [lx] by the rays of each half; empty when done
    std::vector<float> nearest_, noise_;  ///< [N] [m], and variance of a half
    std::vector<std::uint8_t> steps_;     ///< [N] bit s: may step over kSteps[s]
};

}  // namespace lumel
