#pragma once
// What lobes send on, carried from lumel to lumel along rays.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/near/world_lumels.h"
#include "lights/lamps.h"
#include "rays/paths/samples.h"
#include "rays/paths/surfaces.h"
#include "scene/values/sky.h"

namespace lumel {

/// Particles of equal power. They start where light leaves surfaces equally in all directions, or
/// where that of the sky and of lamps arrives, and go on along lobes alone: what lumels send
/// diffusely, and what sky and lamps send, is the caller's to bring to the first ones.
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
    /// exitance: [N] [lm/m²] that lumels send diffusely. direct: [N] [lx] that sky and lamps bring
    /// them, about; or empty, if there are none. About as many particles as requested. The same
    /// seed and light give the same bytes.
    Carried carry(std::span<const glm::vec3> exitance, std::span<const glm::vec3> direct,
                  std::size_t particles, std::uint32_t seed) const;

private:
    struct Landing;
    struct Start;
    struct PathHit;
    struct Sought;
    std::vector<Start> starts_of(std::span<const glm::vec3> exitance,
                                 std::span<const glm::vec3> direct, std::size_t particles,
                                 std::uint32_t seed) const;
    Sought seek_light(const LumelPoint& y, const PathSamples& samples) const;
    bool arrive(const Start& start, PathHit& arrival) const;
    bool fly(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& power,
             std::uint32_t bits, PathHit& arrival) const;
    void follow(const Start& start, std::vector<Landing>& landings) const;

    const RayScene* rays_;
    const Lumels* lumels_;
    WorldLumels world_;
    Surfaces surfaces_;
    HitLumels hits_;
    Lamps lamps_;
    std::optional<SkySampler> sky_;  ///< empty without a sky
    bool any_;
};

}  // namespace lumel
