#pragma once
// Guided rays: lumels send more rays to where earlier ones found the most light [MGN17], drawn by
// their random numbers [GBBE18]; these rays count less, so that expected values remain.
//
// [MGN17]  T. Müller, M. Gross, J. Novák. Practical Path Guiding for Efficient Light-Transport
//          Simulation. EGSR 2017.
// [GBBE18] J. Guo, P. Bauszat, J. Bikker, E. Eisemann. Primary Sample Space Path Guiding. EGSR
//          Experimental Ideas & Implementations 2018.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "links/direct/solutions.h"

namespace lumel {

/// Probabilities of the directions in which groups of neighbouring lumels send rays: of points of
/// the unit square, from which by_cosine() makes directions, in kSide × kSide bins. Group 0 draws
/// uniformly. Empty: all lumels do.
struct RayGuide {
    static constexpr std::uint32_t kSide = 16, kBins = kSide * kSide;
    /// A probability of 1, and that of each bin if all are equal.
    static constexpr std::uint32_t kOne = 1u << 16, kUniform = kOne / kBins;

    using Probabilities = std::array<std::uint16_t, kBins>;  ///< [1 / kOne] each at least 1

    struct Table {
        Probabilities probabilities;
        float gain;  ///< variance of a uniform ray / of a guided one
    };

    std::vector<std::uint32_t> group;  ///< [N]
    std::vector<Table> tables;         ///< [groups]

    /// Equal probabilities: the table of group 0.
    static Table uniform();
    /// Weight of a ray to a bin of that probability.
    static float weight(std::uint16_t probability) { return float(kUniform) / float(probability); }
    /// Bin of a point in the unit square.
    static std::uint32_t bin_of(const glm::vec2& point);

    bool empty() const { return group.empty(); }
    /// True if this is empty, or sound for as many lumels.
    bool fits(std::size_t lumels) const;

    template <class Archive>
    void state(Archive& archive)
    {
        archive(group, tables);
    }
};

/// Draws directions of one group.
class GuidedDraw {
public:
    explicit GuidedDraw(const RayGuide::Probabilities& probabilities);

    struct Drawn {
        glm::vec2 point;  ///< in the unit square
        std::uint32_t bin;
    };
    /// Uniform points become points of that density; nets stay stratified.
    Drawn operator()(const glm::vec2& uniform) const;
    std::uint16_t probability(std::uint32_t bin) const { return probabilities_[bin]; }

private:
    const RayGuide::Probabilities& probabilities_;
    std::array<std::uint32_t, RayGuide::kSide + 1> rows_;  ///< running sums
};

/// Second moments of the light along uniform rays of a group, in each solution.
class GuideMoments {
public:
    /// Adds a ray. light: along it.
    void add(std::size_t solution, std::uint32_t bin, double light);

    /// The table with the least variance of rays of another solution than those that it is learnt
    /// from; empty if uniform rays are as good.
    std::optional<RayGuide::Table> find() const;

private:
    using Bins = std::array<double, RayGuide::kBins>;

    static RayGuide::Probabilities probabilities_for(const Bins& square, double share);
    double variance(std::size_t solution, const RayGuide::Probabilities& probabilities) const;

    std::array<Bins, kSolutions> square_{};   ///< Σ f²
    std::array<double, kSolutions> light_{};  ///< Σ f
    std::array<double, kSolutions> rays_{};
};

}  // namespace lumel
