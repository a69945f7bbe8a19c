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
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Chances of the directions in which groups of neighbouring lumels send rays: of points of the
/// unit square, from which by_cosine() makes directions, in kSide × kSide bins. Group 0 draws
/// evenly. Empty: all lumels do.
struct RayGuide {
    static constexpr std::uint32_t kSide = 16, kBins = kSide * kSide;
    /// Sum of the chances of a group's bins, and the chance of one that is drawn evenly.
    static constexpr std::uint32_t kAll = 1u << 16, kEven = kAll / kBins;

    using Chances = std::array<std::uint16_t, kBins>;  ///< each at least 1

    std::vector<std::uint32_t> group;  ///< [N]
    std::vector<Chances> chances;      ///< [groups]
    std::vector<float> gain;           ///< [groups] variance of an even ray / of a guided one

    /// Weight of a ray to a bin of that chance.
    static float weight(std::uint16_t chance) { return float(kEven) / float(chance); }
    /// Bin of a point in the unit square.
    static std::uint32_t bin_of(const glm::vec2& point);

    bool empty() const { return group.empty(); }
    /// True if this is empty, or sound for as many lumels.
    bool fits(std::size_t lumels) const;

    template <class Archive>
    void state(Archive& archive)
    {
        archive(group, chances, gain);
    }
};

/// Neighbours that face the same way, by their numbers in an order.
struct LumelRange {
    std::size_t first, last;
};

/// Draws directions of one group.
class GuidedDraw {
public:
    explicit GuidedDraw(const RayGuide::Chances& chances);

    struct Drawn {
        glm::vec2 point;  ///< in the unit square
        std::uint32_t bin;
    };
    /// Uniform points become points of that density; nets stay stratified.
    Drawn operator()(const glm::vec2& uniform) const;
    std::uint16_t chance(std::uint32_t bin) const { return chances_[bin]; }

private:
    const RayGuide::Chances& chances_;
    std::array<std::uint32_t, RayGuide::kSide + 1> rows_;  ///< running sums
};

/// Second moments of the light along even rays of a group, of independent solutions.
class GuideMoments {
public:
    GuideMoments(std::size_t solutions) : square_(solutions), light_(solutions), rays_(solutions) {}

    /// Adds a ray. light: along it.
    void add(std::size_t solution, std::uint32_t bin, double light);

    struct Found {
        RayGuide::Chances chances;
        float gain;  ///< variance with even chances / that with these
    };
    /// The chances with the least variance of rays of another solution than those from which they
    /// follow; empty if even ones are as good.
    std::optional<Found> find() const;

private:
    using Bins = std::array<double, RayGuide::kBins>;

    static RayGuide::Chances chances_for(const Bins& square, double share);
    double variance(std::size_t solution, const RayGuide::Chances& chances) const;

    std::vector<Bins> square_;   ///< [solutions] Σ f²
    std::vector<double> light_;  ///< [solutions] Σ f
    std::vector<double> rays_;   ///< [solutions]
};

}  // namespace lumel
