#pragma once
// Light sources for shadow rays: emissive surfaces, lamps, suns, and the bright parts of a sky.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/cells/ray_origins.h"
#include "base/core/box.h"
#include "rays/paths/surfaces.h"
#include "scene/values/scene.h"

namespace lumel {

/// Unoccluded light of a source at a point, along one direction.
struct SourceSample {
    glm::vec3 direction{0.0f};   ///< unit, towards the source
    float distance = 0.0f;       ///< [m], infinite for skies and suns
    float ray_offset = 0.0f;     ///< [m] by which shadow rays end before it
    glm::vec3 irradiance{0.0f};  ///< estimate [lx] at the surface, cosine included
    /// Total unoccluded irradiance of the source [lx], if known exactly.
    std::optional<glm::vec3> open = {};
    std::uint32_t source = 0;  ///< index in its LightSources
};

/// Where light is received, for sampling weights.
struct Receiver {
    Box box;          ///< around its points [m]
    glm::vec3 point;  ///< one of them [m]
    /// Unit; all points then lie in a plane, and only light from above it counts. 0: from all
    /// sides.
    glm::vec3 normal{0.0f};
};
Receiver receiver_of(const WorldLumels& world, std::size_t lumel);
/// A point, whose normal may be 0.
inline Receiver receiver_at(const glm::vec3& position, const glm::vec3& normal)
{
    return {{position, position}, position, normal};
}

/// Lights of a scene that count as sources.
struct LightSelection {
    bool surfaces = true, lamps = true, sky = true;
    std::vector<std::uint32_t> instances{};  ///< whose surfaces count; empty: all
};

/// Lamps and suns alone, and none.
inline const LightSelection kLampsAlone{.surfaces = false, .sky = false};
inline const LightSelection kNoSources{.surfaces = false, .lamps = false, .sky = false};

/// The light sources of a scene, to be sampled by shadow rays.
class LightSources {
public:
    /// The scene and its surfaces must outlive this and not move. extent: diagonal of the scene
    /// [m].
    LightSources(const Scene& scene, const Surfaces& surfaces, float extent,
                 LightSelection selection = {});

    /// Updates the positions of lamps and surfaces.
    void place();
    /// Finds all sources again, after lamps, emission or sky of the scene have changed.
    void find();

    std::size_t count() const { return sources_.size(); }

    /// Owner and bounds of a source.
    enum class Part { material, light, sky };
    struct SourceInfo {
        Part part;
        std::uint32_t index;                 ///< material's or light's
        std::uint32_t instance;              ///< if a surface
        glm::vec3 centre;                    ///< centre of the bounding sphere [m]
        float radius;                        ///< bounding radius [m]
        Box box;                             ///< bounding box [m]
        const PunctualLight* sun = nullptr;  ///< if it is one: infinitely far away
    };
    SourceInfo origin(std::size_t source) const;

    /// Draws one sample. at: uniform sample in the unit square.
    SourceSample sample(std::size_t source, const RayOrigin& start, const glm::vec2& at) const;

    /// Sampling weight: rough unoccluded irradiance of a source on a receiver [lx], > 0 wherever it
    /// can contribute, and 0 where planes or cones show that it cannot, as in [CEK18].
    float sampling_weight(std::size_t source, const Receiver& receiver) const;

    /// True if the source covers a small solid angle, as a sun or a point does.
    bool is_small(std::size_t source) const { return sources_[source].small; }

    /// Sky without the bright parts that became a source [cd/m²], for rays without a hit.
    glm::vec3 dim_sky(const glm::vec3& direction) const;

private:
    struct Triangle {
        glm::vec3 corner[3];  ///< counter-clockwise from the side that emits
        glm::vec3 normal;     ///< unit
        float area;           ///< [m²]
        float reach;          ///< [m], see ray_offset_for()
        float longest_edge;   ///< [m]
        Box box;              ///< [m]
        float power;          ///< area × mean emission, luminance
        std::size_t surface;
        std::uint32_t index;  ///< in its primitive
        bool swapped;         ///< corners 1 and 2 are swapped, because the instance mirrors
    };
    enum class Kind { polygons, mesh, lamp, sun, sky };
    struct Source {
        Kind kind;
        bool small = false;
        std::uint32_t first = 0, last = 0;  ///< range of triangles, or the light's index
        bool double_sided = false;
        bool uniform = false;      ///< one emission everywhere
        glm::vec3 emission{0.0f};  ///< E [lm/m²], if uniform
        double power = 0.0;        ///< by luminance: surfaces [lm], lamps at most [cd], skies [lx]
        glm::vec3 centre{0.0f};    ///< [m]
        float radius = 0.0f;       ///< bounding radius [m]
        Box box;                   ///< bounding box [m]
        glm::vec3 normal{0.0f};    ///< unit, if it is flat and emits to one side; else 0
    };

    SourceSample sample_of(const Source& source, const RayOrigin& start, const glm::vec2& at) const;
    void add_surfaces(const Surfaces& surfaces);
    void add_surface(const Surfaces& surfaces, std::size_t index);
    void add_lights();
    bool counts(std::uint32_t instance) const;
    void cut_sky();
    float form_factors(const Source& source, const RayOrigin& start, float* of_triangles) const;
    SourceSample from_triangle(const Source& source, const Triangle& triangle, float chance,
                               const RayOrigin& start, const glm::vec2& at) const;
    SourceSample by_form_factor(const Source& source, const RayOrigin& start, glm::vec2 at) const;
    bool is_above_surface(const Source& source, const RayOrigin& start) const;
    bool is_near(const Source& source, const RayOrigin& start) const;
    static bool is_wide(const Triangle& triangle, const glm::vec3& from);
    SourceSample by_power(const Source& source, const RayOrigin& start, const glm::vec2& at) const;
    SourceSample from_lamp(const PunctualLight& light, const RayOrigin& start,
                           const glm::vec2& at) const;
    SourceSample from_sun(const PunctualLight& light, const RayOrigin& start,
                          const glm::vec2& at) const;
    SourceSample from_sky(const RayOrigin& start, const glm::vec2& at) const;
    void find_normal(Source& source) const;
    float lamp_weight(const Source& source, const Receiver& receiver, float apart) const;

    const Scene* scene_;
    const Surfaces* surfaces_;
    float extent_;  ///< [m]
    LightSelection selection_;
    std::vector<Source> sources_;
    std::vector<Triangle> triangles_;
    std::vector<double> running_;  ///< [triangles] running power within their source, up to 1
    Sky bright_;                   ///< sky above `most_`
    std::optional<SkySampler> bright_sampler_;
    double bright_power_ = 0.0;  ///< its power by luminance [lx]; 0 if none
    float most_ = 0.0f;          ///< maximum luminance of dim_sky() [cd/m²]
};

}  // namespace lumel
