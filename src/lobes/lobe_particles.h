#pragma once
// What lobes send on, carried from lumel to lumel along rays.

#include <cstdint>
#include <span>
#include <vector>

#include "nearfield/hit_lumels.h"
#include "nearfield/world_lumels.h"
#include "paths/surfaces.h"

namespace lumel {

/// Particles of equal power. They start where light leaves surfaces equally in all directions, and
/// go on along lobes alone: what lumels send diffusely is the caller's to bring to the first ones.
class LobeParticles {
public:
    /// All that is given must outlive this, unmoved; of the lumels, gloss and areas count.
    LobeParticles(const Scene& scene, const Atlas& atlas, const RayScene& rays,
                  const Lumels& lumels);

    /// False if no lumel has a lobe.
    bool any() const { return any_; }

    /// An unbiased estimate.
    struct Carried {
        std::vector<glm::vec3> irradiance;  ///< [N] [lx] that arrives from lobes
        std::vector<glm::vec3> reflected;   ///< [N] [lm/m²] that lobes reflect of it
    };
    /// exitance: [N] [lm/m²] that lumels send diffusely. About as many particles as requested. The
    /// same seed and exitance give the same bytes.
    Carried carry(std::span<const glm::vec3> exitance, std::size_t particles,
                  std::uint32_t seed) const;

private:
    struct Landing;
    struct Start;
    std::vector<Start> starts_of(std::span<const glm::vec3> exitance, std::size_t particles,
                                 std::uint32_t seed) const;
    void follow(const Start& start, std::vector<Landing>& landings) const;

    const RayScene* rays_;
    const Lumels* lumels_;
    WorldLumels world_;
    Surfaces surfaces_;
    HitLumels hits_;
    bool any_;
};

}  // namespace lumel
