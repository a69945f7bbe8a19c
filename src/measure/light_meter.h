#pragma once
// What a light meter shows at a point of a solved scene, in the air or on a surface.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "links/sources.h"
#include "nearfield/hit_lumels.h"
#include "paths/surfaces.h"
#include "rays/ray_scene.h"

namespace lumel {

struct LightMeterOptions {
    std::uint32_t samples = 4096;  ///< rays by the cosine, and as many towards sources
    std::uint32_t seed = 1;
};

/// Where a meter is held. It blocks nothing.
struct MeterPoint {
    glm::vec3 position{0.0f};            ///< world [m]
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< unit: what it faces
};

struct Reading {
    glm::vec3 light{0.0f};  ///< H, linear RGB [lx]
    double lux = 0.0;       ///< illuminance: its luminance [lx]
    double noise = 0.0;     ///< standard error of lux, of the rays alone [lx]
    bool inside = false;    ///< most of what it faces are backs of single-sided surfaces
};

/// Safe to use from many threads at once.
class LightMeter {
public:
    /// irradiance [N] [lx] of the lumels, as solved, taken as diffuse. All but irradiance must
    /// outlive this, unmoved.
    LightMeter(const Scene& scene, const RayScene& rays, const Atlas& atlas, const Lumels& lumels,
               std::span<const glm::vec3> irradiance, const LightMeterOptions& options);

    /// number: of the point; others have other random numbers.
    Reading read(const MeterPoint& point, std::uint32_t number) const;

    /// Is there any light but the sky's?
    bool has_lamps() const { return sources_.count() > 0; }

private:
    /// Sources as one point has rays for them.
    struct Shares {
        struct Own {
            std::size_t source;
            std::uint32_t rays;
        };
        std::vector<Own> own;         ///< that have rays of their own
        std::vector<float> rest;      ///< [sources] running sums of the guesses of the others
        std::uint32_t rest_rays = 0;  ///< that these share
    };

    Shares share_out(const RayStart& start) const;
    glm::vec3 met_along(const RayStart& start, const glm::vec3& direction, std::uint32_t seed,
                        std::uint32_t& backs) const;
    glm::vec3 along_rays(const RayStart& start, std::uint32_t stream, std::uint32_t& backs) const;
    glm::vec3 from_sources(const RayStart& start, const Shares& shares, std::uint32_t stream) const;
    glm::vec3 from_source(const RayStart& start, const Shares::Own& own,
                          std::uint32_t stream) const;
    glm::vec3 from_rest(const RayStart& start, const Shares& shares, std::uint32_t stream) const;
    glm::vec3 passing(const RayStart& start, const SourceSample& sample, std::uint32_t seed) const;

    const RayScene& rays_;
    Surfaces surfaces_;
    LightSources sources_;
    HitLumels hits_;
    std::vector<glm::vec3> reflected_;  ///< [N] ρ H [lm/m²], 0 of buried lumels
    std::uint32_t rays_of_set_, seed_;
};

}  // namespace lumel
