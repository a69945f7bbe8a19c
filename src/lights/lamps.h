#pragma once
// The punctual lights of a scene as rays on the host sample them, for the truth, `update` and
// `why`. Bakes find their light on the device (raster/shadow_maps/lamps.h) or by links
// (lights/sources.h), with code of their own on purpose: the truth judges it. See lamps.cpp for the
// equations.

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// What a lamp sends to a point along one direction, as if nothing were between.
struct LampSample {
    glm::vec3 direction{0.0f};    ///< unit, towards the lamp
    float distance = 0.0f;        ///< [m] to its surface; infinite: directional
    glm::vec3 illuminance{0.0f};  ///< estimate [lx] for a plane that faces the direction
};

/// What of a lamp's light gets through to a point [0…1]. offset: as RayScene::transmittance takes
/// it.
glm::vec3 transmittance(const RayScene& rays, const glm::vec3& position, const LampSample& lamp,
                        float offset, std::uint32_t seed);

class Lamps {
public:
    /// `scene` must outlive this, unmoved.
    explicit Lamps(const Scene& scene);

    std::size_t count() const { return lamps_.size(); }

    /// Draws a direction, by a point of the unit disc, of those that a lamp shines from.
    LampSample sample(std::size_t lamp, const glm::vec3& position, const glm::vec2& disc) const;

private:
    struct Lamp {
        const PunctualLight* light = nullptr;
        glm::vec3 position{0.0f};  ///< world [m]
        glm::vec3 toward{0.0f};    ///< unit, opposite to its light
    };

    LampSample from_disc(const Lamp& lamp, const glm::vec2& disc) const;
    LampSample from_ball(const Lamp& lamp, const glm::vec3& position, const glm::vec2& disc) const;

    const Scene* scene_;
    std::vector<Lamp> lamps_;  ///< those that shine
};

}  // namespace lumel
