#pragma once
// `prog`: a competitor of the methods, not one of them. See iterated_gather.cpp.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/hit_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "rays/paths/samples.h"
#include "rays/paths/surfaces.h"
#include "truth/lights.h"
#include "truth/lumel_starts.h"

namespace lumel::bench {

/// A progressive lightmapper: gathers through the lightmap itself, pass after pass. Of matte
/// surfaces.
class IteratedGather {
public:
    /// `place` must outlive it.
    IteratedGather(const SolveScene& place, SampleRule rule, std::uint32_t seed);

    /// A few rays more from every lumel.
    void pass();

    /// Rays of each lumel that count, 0 while it warms up.
    std::uint32_t rays() const { return passes_ > warm_up_ ? bounced_.rays : 0; }

    /// H [N] [lx], of buried lumels 0.
    std::vector<glm::vec3> irradiance() const;

private:
    /// Estimates of light, summed over rays.
    struct Sums {
        std::vector<glm::vec3> light;  ///< [N] [lx]
        std::uint32_t rays = 0;        ///< of each lumel
    };
    /// One estimate of the light at a point [lx].
    struct Seen {
        glm::vec3 direct{0.0f};
        glm::vec3 bounced{0.0f};
    };

    Seen look(PathVertex vertex, const PathSamples& samples) const;
    bool is_open(std::uint32_t lumel) const;

    const SolveScene& place_;
    Surfaces surfaces_;
    Lights lights_;
    LumelStarts starts_;
    HitLumels hits_;
    std::uint32_t seed_;
    std::uint32_t warm_up_;  ///< passes before rays count
    std::uint32_t passes_ = 0;
    Sums direct_, bounced_;
    std::vector<glm::vec3> present_;  ///< [N] [lx] the lightmap that rays look light up in
};

}  // namespace lumel::bench
