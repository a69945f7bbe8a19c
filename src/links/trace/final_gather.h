#pragma once
// Final gather: cosine-distributed rays look up direct and coarse indirect light where they hit.

#include <vector>

#include "links/direct/direct_rays.h"
#include "links/rays/tracer.h"
#include "links/sweeps/source_term.h"

namespace lumel {

/// Indirect irradiance of lumels, given coarse indirect light: rays return the direct light of the
/// cell that they hit, plus the coarse light.
class FinalGather {
public:
    /// All arguments must outlive this. received: [N] coarse indirect irradiance [lx]. rays: per
    /// lumel, rounded up to a multiple of kGatherRays.
    FinalGather(const DirectRays& direct, std::vector<glm::vec3> received, std::uint32_t rays,
                std::uint32_t seed);

    bool done() const { return round_ == rounds_; }
    /// Works for a fraction of a second.
    void step();
    /// H [N] [lx]
    std::vector<glm::vec3> irradiance() const;

private:
    void take(std::size_t last);
    void take(const LinkRow& row, std::size_t lumel);

    const DirectRays& direct_;
    std::vector<glm::vec3> sent_;  ///< [N] [lm/m²] reflected coarse light
    SubLumels parts_;
    LinkNumbers numbers_;
    LinkTracer tracer_;
    ReflectedLight reflected_;
    std::uint32_t round_ = 0, rounds_;
    std::size_t block_ = 0;
    LinkTable links_;             ///< current round
    std::vector<glm::vec3> sum_;  ///< [N] over all rays
    std::vector<std::uint32_t> rays_;
};

/// Rays per lumel and round.
inline constexpr std::uint32_t kGatherRays = 64;

/// Rays per lumel for an error of its last bounce below `error` × the mean of all light.
std::uint32_t gather_rays(double error);

}  // namespace lumel
