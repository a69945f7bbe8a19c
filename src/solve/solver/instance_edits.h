#pragma once
// Changes of a live scene's instances, requested between its updates: transforms and factors.

#include <optional>
#include <vector>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel {

class InstanceEdits {
public:
    /// movers: movable instances; empty: all. still: none is movable, `movers` is ignored. Throws
    /// Error{input} if a mover is not an instance.
    InstanceEdits(const Scene& scene, const std::vector<std::uint32_t>& movers, bool still);

    const std::vector<char>& movers() const { return movers_; }  ///< [instances] 1: movable

    /// Requests a transform of an instance (mesh to world). Throws Error{input} if it is not
    /// movable or would be stretched: lumels keep their areas.
    void move(const Scene& scene, std::uint32_t instance, const glm::mat4& transform);
    bool is_move_requested() const;
    /// The requested transform if it differs from the scene's; the request ends.
    std::optional<glm::mat4> take_move(const Scene& scene, std::uint32_t instance);

    /// Scale all lumels of an instance relative to the scene. Throw Error{input} if there is no
    /// such instance or a factor is negative.
    void set_emission(std::uint32_t instance, const glm::vec3& factor);
    void set_reflectance(std::uint32_t instance, const glm::vec3& factor);
    /// The lumels with these factors; reflectances are capped at Scene::max_albedo.
    Lumels scaled(Lumels lumels) const;

private:
    float max_albedo_;
    std::vector<char> movers_;
    std::vector<std::optional<glm::mat4>> requested_;              ///< [instances]
    std::vector<glm::vec3> emission_factor_, reflectance_factor_;  ///< [instances]
};

}  // namespace lumel
