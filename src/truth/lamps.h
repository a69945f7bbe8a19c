#pragma once
// Punctual lights of a scene, sampled by the path tracer. What it judges has code of its own:
// lights/sources.h for rays, raster/shadow_maps/lamps.h for shadow maps. Equations: lamps.cpp.

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// Unoccluded light of a lamp at a point, along one direction.
struct LampSample {
    glm::vec3 direction{0.0f};    ///< unit, towards the lamp
    float distance = 0.0f;        ///< [m] to its surface; infinite if directional
    glm::vec3 illuminance{0.0f};  ///< estimate [lx] on a plane facing the direction
};

/// Transmittance [0…1] towards a lamp sample. offset: as in RayScene::transmittance.
glm::vec3 transmittance(const RayScene& rays, const glm::vec3& position, const LampSample& lamp,
                        float offset, std::uint32_t seed);

class Lamps {
public:
    /// `scene` must outlive this and not move.
    explicit Lamps(const Scene& scene);

    std::size_t count() const { return lamps_.size(); }

    /// Samples a direction of a lamp. disc: a point of the unit disc.
    LampSample sample(std::size_t lamp, const glm::vec3& position, const glm::vec2& disc) const;

private:
    struct Lamp {
        const PunctualLight* light = nullptr;
        glm::vec3 position{0.0f};  ///< world [m]
        glm::vec3 toward{0.0f};    ///< unit, opposite to its light's direction
    };

    LampSample from_disc(const Lamp& lamp, const glm::vec2& disc) const;
    LampSample from_ball(const Lamp& lamp, const glm::vec3& position, const glm::vec2& disc) const;

    const Scene* scene_;
    std::vector<Lamp> lamps_;  ///< lamps with light
};

}  // namespace lumel
