#pragma once
// Signed light, transported by particles from lumel to lumel until absorbed.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/near/world_lumels.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Status of a particle transport.
struct CarryState {
    std::uint64_t particles = 0;  ///< total
    double error = 0.0;           ///< [lx] RMS over lumels and channels
    bool gave_up = false;         ///< true: too many particles would be needed
};

struct SignedLight {
    std::vector<glm::vec3> irradiance;  ///< [N] X [lx]
    CarryState state;
};

class LightCarrier {
public:
    /// All arguments must outlive this, unmoved.
    LightCarrier(const RayScene& rays, const Lumels& lumels, const WorldLumels& world,
                 const HitLumels& hits)
        : rays_(&rays),
          lumels_(&lumels),
          world_(&world),
          hits_(&hits)
    {
    }

    /// X = T (source + ρ X), for signed source [N] [lm/m²], by particles: until their error is at
    /// most `error` [lx], more than `most` of them are needed, or go_on, called regularly, returns
    /// false. The same seed gives the same bytes unless that stops them.
    SignedLight carry(std::span<const glm::vec3> source, double error, std::uint64_t most,
                      std::uint32_t seed,
                      const std::function<bool(const CarryState&)>& go_on) const;

private:
    struct Landing;
    std::vector<double> powers_of(std::span<const glm::vec3> source) const;
    void follow(std::uint32_t from, const glm::vec3& power, std::uint32_t stream,
                std::uint32_t index, std::vector<Landing>& landings) const;

    const RayScene* rays_;
    const Lumels* lumels_;
    const WorldLumels* world_;
    const HitLumels* hits_;
};

}  // namespace lumel
