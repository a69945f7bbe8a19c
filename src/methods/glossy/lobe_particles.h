#pragma once
// Light of glossy lobes, carried from lumel to lumel by particles.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/near/world_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "lights/sources.h"
#include "rays/paths/samples.h"
#include "scene/values/sky.h"

namespace lumel {

/// Particles of equal power. They start from diffuse exitance, or from sky and lamp light that
/// arrives, and continue along lobes only: the caller adds diffuse light and light of sky and lamps
/// at the first hits.
class LobeParticles {
public:
    /// The scene must outlive this, unmoved; uses gloss and areas of its lumels.
    explicit LobeParticles(const SolveScene& scene);

    /// False if no lumel has a lobe.
    bool any() const { return any_; }

    /// Unbiased estimate of lobe light.
    struct Carried {
        std::vector<glm::vec3> irradiance;  ///< [N] [lx] irradiance from lobes
        std::vector<glm::vec3> reflected;   ///< [N] [lm/m²] its part reflected by lobes
        double lobe_power = 0.0;            ///< reflected by all lobes, first hits included [lm]
    };
    /// exitance: [N] [lm/m²] diffuse exitance of lumels. direct: [N] [lx] approximate irradiance by
    /// sky and lamps, or empty without these. particles: approximate number. Equal seed and light
    /// give equal bytes.
    Carried carry(std::span<const glm::vec3> exitance, std::span<const glm::vec3> direct,
                  std::size_t particles, std::uint32_t seed) const;

    /// Upper bound on memory of carry() besides its result [bytes], if most particles leave at most
    /// one lobe.
    static std::uint64_t host_bytes(std::size_t particles);

private:
    struct Landing;
    struct Followed;
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
    void follow(const Start& start, Followed& followed) const;

    const RayScene* rays_;
    const Lumels* lumels_;
    const Surfaces* surfaces_;
    WorldLumels world_;
    HitLumels hits_;
    LightSources lamps_;
    std::optional<SkySampler> sky_;  ///< empty without a sky
    bool any_;
};

}  // namespace lumel
