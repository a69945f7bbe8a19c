#pragma once
// What sends light by itself, for points that look for it: emissive surfaces, lamps, suns, and the
// bright parts of a sky.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/cells/ray_origins.h"
#include "base/core/box.h"
#include "rays/paths/surfaces.h"
#include "scene/values/scene.h"

namespace lumel {

/// What a source sends to a point along one direction, as if nothing were between.
struct SourceSample {
    glm::vec3 direction{0.0f};   ///< unit, towards the source
    float distance = 0.0f;       ///< [m], infinite for skies and suns
    glm::vec3 irradiance{0.0f};  ///< estimate [lx] at the surface, cosine included
    /// All that the source sends here [lx], where that is known exactly.
    std::optional<glm::vec3> open = {};
};

/// A source of light that rays look for.
class LightSources {
public:
    /// The scene and its surfaces must outlive this, unmoved. extent: of the scene [m].
    LightSources(const Scene& scene, const Surfaces& surfaces, float extent);

    /// Finds lamps and surfaces again, where they are now.
    void place();

    std::size_t count() const { return sources_.size(); }

    /// What a source is part of, and where it is.
    enum class Part { material, light, sky };
    struct SourceInfo {
        Part part;
        std::uint32_t index;                 ///< of the material or the light
        std::uint32_t instance;              ///< of a surface
        glm::vec3 centre;                    ///< of a ball around it [m]
        float radius;                        ///< [m]
        Box box;                             ///< around it [m]
        const PunctualLight* sun = nullptr;  ///< that it is; then it is infinitely far away
    };
    SourceInfo origin(std::size_t source) const;

    /// One sample; `at` in the unit square.
    SourceSample sample(std::size_t source, const RayOrigin& start, const glm::vec2& at) const;

    /// A guess of what a source sends to the neighbourhood of a point [lx], never 0 where it could
    /// send any; rays are shared out by it.
    float sampling_weight(std::size_t source, const glm::vec3& position, float size) const;

    /// Is the light of the source's shape small in the sky, as a sun's or a point's?
    bool is_small(std::size_t source) const { return sources_[source].small; }

    /// What is left of a sky after its bright parts became a source [cd/m²], for rays that meet
    /// nothing.
    glm::vec3 dim_sky(const glm::vec3& direction) const;

private:
    struct Triangle {
        glm::vec3 corner[3];  ///< counter-clockwise from the side that emits
        glm::vec3 normal;     ///< unit
        float area;           ///< [m²]
        float power;          ///< area × mean emission, luminance
        std::size_t surface;
        std::uint32_t index;  ///< in its primitive
        bool swapped;         ///< corners 1 and 2 are, since the instance mirrors
    };
    enum class Kind { polygons, mesh, lamp, sun, sky };
    struct Source {
        Kind kind;
        bool small = false;
        std::uint32_t first = 0, last = 0;  ///< triangles, or the light
        bool double_sided = false;
        bool uniform = false;      ///< one emission all over
        glm::vec3 emission{0.0f};  ///< E [lm/m²], of a uniform one
        double power = 0.0;      ///< by luminance: of surfaces [lm], lamps at most [cd], skies [lx]
        glm::vec3 centre{0.0f};  ///< [m]
        float radius = 0.0f;     ///< of a ball around it [m]
        Box box;                 ///< around it [m]
    };

    void add_surfaces(const Surfaces& surfaces);
    void add_surface(const Surfaces& surfaces, std::size_t index);
    void add_lights();
    void cut_sky();
    float form_factors(const Source& source, const RayOrigin& start, float* of_triangles) const;
    SourceSample from_triangle(const Source& source, const Triangle& triangle, float chance,
                               const RayOrigin& start, const glm::vec2& at) const;
    SourceSample from_polygons(const Source& source, const RayOrigin& start, glm::vec2 at) const;
    bool is_above_surface(const Source& source, const RayOrigin& start) const;
    SourceSample from_mesh(const Source& source, const RayOrigin& start, const glm::vec2& at) const;
    SourceSample from_lamp(const PunctualLight& light, const RayOrigin& start,
                           const glm::vec2& at) const;
    SourceSample from_sun(const PunctualLight& light, const RayOrigin& start,
                          const glm::vec2& at) const;
    SourceSample from_sky(const RayOrigin& start, const glm::vec2& at) const;

    const Scene* scene_;
    const Surfaces* surfaces_;
    float extent_;  ///< [m]
    std::vector<Source> sources_;
    std::vector<Triangle> triangles_;
    std::vector<double> running_;  ///< [triangles] sums of power within their source, to 1
    Sky bright_;                   ///< what the sky has above `most_`
    std::optional<SkySampler> bright_sampler_;
    double bright_power_ = 0.0;  ///< of that, by luminance [lx]; 0: there is none
    float most_ = 0.0f;          ///< [cd/m²] by luminance, that rays which meet nothing find
};

}  // namespace lumel
