#pragma once
// Light of a solved scene at ray hits.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/hit_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "lights/lamps.h"
#include "lights/sources.h"

namespace lumel {

/// Looks up a scene's lightmap and lumels at ray hits, for the light of all lamps or of each. All
/// arguments must outlive this.
class LitScene {
public:
    /// The light of all lamps, as one layer. The maps hold the finished irradiance of each side
    /// [lx]; back: empty if equal to `front`.
    LitScene(const SolveScene& scene, const Image& front, const Image& back);
    /// A layer for each lamp: its finished irradiance [lx], of both sides.
    LitScene(const SolveScene& scene, std::span<const Image> maps, const LampTable& lamps);

    const RayScene& rays() const { return scene_->rays; }
    const Surfaces& surfaces() const { return scene_->surfaces; }

    std::size_t layers() const { return front_maps_.size(); }

    /// H on the side that was hit, bilinear [lx].
    glm::vec3 irradiance(const RayHit& hit, std::size_t layer = 0) const;

    /// Adds the light that leaves a hit, of each layer, × weight: its luminance, and the reflection
    /// by ρ_d [cd/m²]. sum: [layers()].
    void add_light(const RayHit& hit, const glm::vec3& luminance, const glm::vec3& diffuse,
                   const glm::vec3& weight, std::span<glm::vec3> sum) const;

    /// Adds the radiance of the sky in a unit direction × weight [cd/m²].
    void add_sky(const glm::vec3& direction, const glm::vec3& weight,
                 std::span<glm::vec3> sum) const
    {
        sum[sky_layer_] += weight * sky_radiance(scene_->scene.sky, direction);
    }
    /// The layer of the sky.
    std::size_t sky_layer() const { return sky_layer_; }

    const LightSources& lamps() const { return lamps_; }
    std::size_t layer_of_lamp(std::size_t lamp) const { return layer_of_lamp_[lamp]; }

    /// Index of the lumel on the side that was hit; HitLumels::kNone if there is none.
    std::uint32_t lumel(const RayHit& hit) const { return lumels_.lumel(hit); }

private:
    const SolveScene* scene_;
    HitLumels lumels_;
    LightSources lamps_;
    std::vector<const Image*> front_maps_, back_maps_;  ///< [layers]
    std::vector<std::uint32_t> layer_of_lamp_;          ///< [LightSources::count()]
    std::vector<std::uint32_t> layer_of_instance_;      ///< of its emission
    std::uint32_t sky_layer_ = 0;
};

}  // namespace lumel
