#pragma once
// What sky, sun and lamps send straight to the lumels of a scene in which things move.

#include <optional>
#include <span>
#include <vector>

#include "raster/shadow_maps/direct_light.h"

namespace lumel {

class LiveLamps {
public:
    /// The scene's sky and lights are looked at here only.
    LiveLamps(const Scene& scene, const DirectLightOptions& options);

    /// True if there are none.
    bool empty() const { return sources_.empty(); }
    /// What a light, or the sky, sends is `factor` times its value in the scene. Throws
    /// Error{input} if there is no such light, no sky, or a factor is negative.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Begins to find it anew, with things where the world has them. All must outlive the search,
    /// and the world stay as it is.
    void begin(const gpu::Device& device, const World& world, const Lumels& lumels);
    /// A few views. Returns false once nothing is left to do; then what was found counts.
    bool step();
    /// All of it at once.
    void find(const gpu::Device& device, const World& world, const Lumels& lumels);
    bool is_under_way() const { return search_.has_value(); }
    /// [N] lx as found last, with the factors as they are now; empty if there are no lamps.
    std::vector<glm::vec3> irradiance() const;

private:
    struct Source {
        Scene scene;          ///< of one light, or of the sky, without geometry
        std::uint32_t light;  ///< index into Scene::lights, or kSky
        glm::vec3 factor{1.0f};
        std::vector<glm::vec3> irradiance;  ///< [N] lx where the factor is 1
        std::vector<glm::vec3> fresh;       ///< the same as it is being found
    };

    void set(std::uint32_t light, const glm::vec3& factor, const std::string& name);

    void search();

    DirectLightOptions options_;
    std::vector<Source> sources_;
    const gpu::Device* device_ = nullptr;  ///< of the search
    const World* world_ = nullptr;
    const Lumels* lumels_ = nullptr;
    std::size_t at_ = 0;  ///< source that is searched
    std::optional<DirectLightSearch> search_;
};

}  // namespace lumel
