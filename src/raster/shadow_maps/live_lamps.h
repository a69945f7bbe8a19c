#pragma once
// Direct light of sky, sun and lamps in a scene with moving objects.

#include <optional>
#include <span>
#include <vector>

#include "raster/shadow_maps/direct_light.h"

namespace lumel {

class LiveLamps {
public:
    /// Copies the scene's sky and lights.
    LiveLamps(const Scene& scene, const DirectLightOptions& options);

    /// True if there are no lights and no sky.
    bool empty() const { return sources_.empty(); }
    /// Scales a light, or the sky, relative to the scene. Throws Error{input} if there is no such
    /// light or sky, or a factor is negative.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Starts a new computation for the world's current transforms. All arguments must outlive it,
    /// and the world must not change.
    void begin(const gpu::Device& device, const World& world, const Lumels& lumels);
    /// Renders a few views. Returns false when done; then the new result applies.
    bool step();
    /// Runs to completion.
    void find(const gpu::Device& device, const World& world, const Lumels& lumels);
    bool is_under_way() const { return search_.has_value(); }
    /// [N] Last result [lx] with the current factors; empty if there are no lamps.
    std::vector<glm::vec3> irradiance() const;

private:
    struct Source {
        Scene scene;          ///< one light or the sky, without geometry
        std::uint32_t light;  ///< index into Scene::lights, or kSky
        glm::vec3 factor{1.0f};
        std::vector<glm::vec3> irradiance;  ///< [N] [lx] at factor 1
        std::vector<glm::vec3> fresh;       ///< [N] [lx] new result
    };

    void set(std::uint32_t light, const glm::vec3& factor, const std::string& name);

    void search();

    DirectLightOptions options_;
    std::vector<Source> sources_;
    const gpu::Device* device_ = nullptr;  ///< for the current computation
    const World* world_ = nullptr;
    const Lumels* lumels_ = nullptr;
    std::size_t at_ = 0;  ///< current source
    std::optional<DirectLightSearch> search_;
};

}  // namespace lumel
