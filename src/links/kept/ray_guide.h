#pragma once
// Guided rays: lumels send more rays to where earlier ones found the most light [MGN17], drawn by
// their random numbers [GBBE18]; these rays count less, so that expected values remain [VG95].
//
// [MGN17]  T. Müller, M. Gross, J. Novák. Practical Path Guiding for Efficient Light-Transport
//          Simulation. EGSR 2017.
// [GBBE18] J. Guo, P. Bauszat, J. Bikker, E. Eisemann. Primary Sample Space Path Guiding. EGSR
//          Experimental Ideas & Implementations 2018.
// [VG95]   E. Veach, L. J. Guibas. Optimally Combining Sampling Techniques for Monte Carlo
//          Rendering. SIGGRAPH 1995.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "links/direct/solutions.h"

namespace lumel {

/// Probabilities of the directions in which groups of neighbouring lumels send rays: of points of
/// the unit square, from which by_cosine() makes directions, in kSide × kSide bins. Group 0 draws
/// uniformly, and so do all lumels in the first round. Empty: in all rounds.
struct RayGuide {
    static constexpr std::uint32_t kSide = 16, kBins = kSide * kSide;
    /// A probability of 1, and that of each bin if all are equal.
    static constexpr std::uint32_t kOne = 1u << 16, kUniform = kOne / kBins;

    using Probabilities = std::array<std::uint16_t, kBins>;  ///< [1 / kOne] each at least 1

    struct OfSolution {
        Probabilities probabilities;
        float gain = 1.0f;  ///< variance of a uniform ray / of a guided one; 1: all are uniform

        template <class Archive>
        void state(Archive& archive)
        {
            archive(probabilities, gain);
        }
    };
    /// Each learnt from the other solutions: weights and numbers of rays that depend on a
    /// solution's own light would change the result.
    using Table = std::array<OfSolution, kSolutions>;

    std::vector<std::uint32_t> group;  ///< [N]
    std::vector<Table> tables;         ///< [groups]

    const OfSolution& of(std::size_t lumel, std::size_t solution) const
    {
        return tables[group[lumel]][solution];
    }

    static OfSolution uniform();
    /// The table of group 0.
    static Table all_uniform() { return {uniform(), uniform(), uniform()}; }
    /// Weight of a ray to a bin of that probability, of `all` rays of which the first `uniform` are
    /// uniform: by the balance heuristic [VG95], as if all were drawn with their mean density.
    static float weight(std::uint16_t probability, float uniform, float all)
    {
        return all / (uniform + (all - uniform) * float(probability) / float(kUniform));
    }
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

private:
    const RayGuide::Probabilities& probabilities_;
    std::array<std::uint32_t, RayGuide::kSide + 1> rows_;  ///< running sums
};

/// Second moments of the light along uniform rays of a group, in each solution.
class GuideMoments {
public:
    /// Adds a ray. light: along it.
    void add(std::size_t solution, std::uint32_t bin, double light);

    /// The tables with the least variance of rays of another solution than those that they are
    /// learnt from; empty if uniform rays are as good.
    std::optional<RayGuide::Table> find() const;

private:
    using Bins = std::array<double, RayGuide::kBins>;

    RayGuide::OfSolution learn(std::size_t one, std::size_t other) const;
    static RayGuide::Probabilities probabilities_for(const Bins& square, double share);
    double variance(std::size_t solution, const RayGuide::Probabilities& probabilities) const;

    std::array<Bins, kSolutions> square_{};   ///< Σ f²
    std::array<double, kSolutions> light_{};  ///< Σ f
    std::array<double, kSolutions> rays_{};
};

}  // namespace lumel
