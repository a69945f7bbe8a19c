#pragma once
// Edge-preserving filter over the lumels of each chart. See links/filter/pyramid.h.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "links/direct/link_work.h"
#include "links/direct/solutions.h"
#include "links/filter/chart_places.h"
#include "links/filter/filter_chart.h"
#include "links/filter/mean.h"
#include "links/filter/pyramid.h"

namespace lumel {

/// Of the rays of each lumel.
struct RayDistances {
    std::vector<float> nearest;  ///< [N] to the nearest hit [m]
    std::vector<float> inverse;  ///< [N] mean of 1 / distance [1/m]; of the sky 0
};

/// Fits light over the lumels of charts. Does not mix lumels of different normal, or across
/// geometry.
class ChartFilter {
public:
    /// The work must outlive this.
    ChartFilter(const LinkWork& work, const SubLumels& parts, const RayDistances& distances);

    /// Memory of this, and in addition while it filters [bytes].
    static std::uint64_t bytes(std::size_t lumels, std::size_t texels);
    static std::uint64_t working_bytes(std::size_t lumels);

    /// Filtered mean of the solutions.
    Mean indirect(const Solutions& found) const;
    /// [N] Fraction of a solution's variance that filter leaves, on average over all lumels as near
    /// to other geometry on charts as large. raw, filtered [N]: variances.
    std::vector<double> variance_left(const std::vector<double>& raw,
                                      const std::vector<double>& filtered) const;
    /// Filtered mean of two halves of direct light. Lumels far from any whose halves differ keep
    /// their light: it is exact.
    Mean direct(const Estimates& one, const Estimates& other) const;

    /// Filters parts of the light of `indirect` and of `direct`, such as that of single lamps [N],
    /// in place and with the same gains, so that they add up to the filtered light.
    void indirect_parts(const Solutions& found, std::span<Estimates> parts) const;
    void direct_parts(const Estimates& one, const Estimates& other,
                      std::span<Estimates> parts) const;

private:
    std::uint8_t find_steps(std::size_t lumel, const std::vector<float>& nearest) const;
    bool may_step(std::size_t i, std::size_t j, float nearest) const;
    glm::vec3 open_middle(std::size_t i) const;
    template <class Visit>
    void visit_lumels(const ChartPlace& place, const Visit& visit) const;
    FilterChart chart_at(const ChartPlace& place) const;
    std::vector<std::uint32_t> find_kinds() const;
    void share(Mean& mean) const;
    template <std::size_t Count, class Visit>
    void filter(const std::array<const Estimates*, Count>& found, const PyramidRule& rule,
                const Visit& visit) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
    std::vector<ChartPlace> places_;
    std::vector<std::uint8_t> steps_;  ///< [N] bit s: the filter may step over kSteps[s]
    std::vector<float> nearness_;      ///< [N] as in FilterChart
};

}  // namespace lumel
