#pragma once
// Light meter at a point of a solved scene, in the air or on a surface.

#include <functional>
#include <vector>

#include "lights/lamps.h"
#include "results/measure/arriving_light.h"

namespace lumel {

struct LightMeterOptions {
    std::uint32_t samples = 4096;  ///< cosine-distributed rays, and as many to sources
    std::uint32_t seed = 1;
};

/// Position and direction of a meter. It occludes nothing.
struct MeterPoint {
    glm::vec3 position{0.0f};            ///< world [m]
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< unit direction that it faces
};

struct Reading {
    glm::vec3 light{0.0f};  ///< H, linear RGB [lx]
    double lux = 0.0;       ///< illuminance: its luminance [lx]
    double noise = 0.0;     ///< standard error of lux by the rays alone [lx]
    bool inside = false;    ///< true if it seems to be inside an object
};

/// Lamps, with the share of each in the light of a solution.
struct LampShares {
    LampTable lamps;
    std::vector<std::vector<glm::vec3>> of_lumels;  ///< [lamps][N] by channel, 0…1
};

struct LampReadings {
    std::vector<double> lux;  ///< [lamps] illuminance [lx]
    bool inside = false;      ///< as Reading::inside
};

/// Thread-safe.
class LightMeter {
public:
    /// As in ArrivingLight.
    LightMeter(const Scene& scene, const RayScene& rays, const Atlas& atlas, const Lumels& lumels,
               std::span<const glm::vec3> irradiance, const LightMeterOptions& options);

    /// number: of the point; selects its random numbers.
    Reading read(const MeterPoint& point, std::uint32_t number) const;

    /// A reading of each lamp; their sum is read().
    LampReadings read_lamps(const MeterPoint& point, std::uint32_t number,
                            const LampShares& shares) const;

    /// Visits the rays of read(), set by set. Returns Reading::inside.
    using RayVisitor =
        std::function<void(std::uint32_t set, const glm::vec3& direction, const MetLight& met)>;
    bool visit_rays(const MeterPoint& point, std::uint32_t number, const RayVisitor& visit) const;
    std::uint32_t rays_in_set() const { return rays_of_set_; }

    /// Light [lx] of a far source in a direction that gives 1 lx on a plane that faces it.
    glm::vec3 light_from(const MeterPoint& point, const glm::vec3& direction,
                         std::uint32_t seed) const;

    const LightSources& sources() const { return light_.sources(); }
    /// True if there is light other than the sky's.
    bool has_lamps() const { return sources().count() > 0; }

private:
    RayOrigin start_at(const MeterPoint& point) const;
    template <class Add>
    void along_rays(const RayOrigin& start, std::uint32_t stream, std::uint32_t& backs,
                    const Add& add) const;
    template <class Add>
    void from_sources(const RayOrigin& start, const RayAllocation& shares, std::uint32_t stream,
                      const Add& add) const;
    glm::vec3 from_source(const RayOrigin& start, const RayAllocation::Own& own,
                          std::uint32_t stream) const;

    ArrivingLight light_;
    std::uint32_t rays_of_set_, seed_;
};

}  // namespace lumel
