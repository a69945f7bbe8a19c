#pragma once
// The last bounce of light, at the row of each lumel: rays from it find who sends what.

#include <vector>

#include "links/direct/direct_rays.h"
#include "links/trace/tracer.h"

namespace lumel {

/// What lumels receive of light that was reflected, if that is known roughly everywhere: rays
/// spread by the cosine take direct light per cell where they end, and the rough light beside it.
class FinalGather {
public:
    /// What is given must outlive it. received: [N] [lx] beside the direct light. rays: of each
    /// lumel; a multiple of kGatherRays is taken.
    FinalGather(const DirectRays& direct, std::vector<glm::vec3> received, std::uint32_t rays,
                std::uint32_t seed);

    bool done() const { return round_ == rounds_; }
    /// A part of a second of work.
    void step();
    /// H [N] [lx]
    std::vector<glm::vec3> irradiance() const;

private:
    void take(std::size_t last);

    const DirectRays& direct_;
    std::vector<glm::vec3> sent_;  ///< [N] [lm/m²] beside what is reflected of direct light
    SubLumels parts_;
    LinkTracer tracer_;
    std::uint32_t round_ = 0, rounds_;
    std::size_t block_ = 0;
    LinkSet gathered_;            ///< of the round at work
    std::vector<glm::vec3> sum_;  ///< [N] over rays
    std::vector<std::uint32_t> rays_;
};

/// Rays of a lumel in a round.
inline constexpr std::uint32_t kGatherRays = 64;

/// That each lumel needs for an error of its last bounce below this part of the mean of all light.
std::uint32_t gather_rays(double error);

}  // namespace lumel
