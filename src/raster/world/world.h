#pragma once
// The scene and its lumels, resident on the GPU.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/core/box.h"
#include "gpu/commands.h"
#include "raster/world/occluders.h"
#include "raster/world/passage.shared.h"
#include "raster/world/world.place_lumels.comp.h"
#include "raster/world/world.place_vertices.comp.h"
#include "raster/world/world.shared.h"

namespace lumel {

/// Lumels tried first when a kind of work is timed (see gpu::Pacer).
inline constexpr std::uint32_t kProbeLumels = 4096;

/// One cut-out material's part of the occluders, with its base colour on the GPU.
struct CutOutDraw {
    OccluderRange range;
    std::unique_ptr<gpu::Target> color;
    std::unique_ptr<gpu::Sampler> sampler;
    Passage passage{};
};

/// Local data stays; placed data (in the world) follows the instances' transforms.
class World {
public:
    /// The world looks at the scene's sky for as long as it lives. `atlas`: which the lumels were
    /// lifted from; null where the places of vertices in it are not needed.
    World(const gpu::Device& device, const Scene& scene, const Lumels& lumels,
          const Atlas* atlas = nullptr, const std::vector<char>& movers = {});

    /// Moves instances to `transforms` [instances]. Waits for the device.
    void place(std::span<const glm::mat4> transforms);

    /// Takes the bounding box, to which views of sky and sun are fitted, from where the scene's
    /// instances stand now. Costs what has moved since.
    void bound(const Scene& scene);

    /// From now on views show movers, as they do at first, or not.
    void show_movers(bool shown) { movers_shown_ = shown; }
    /// What views draw of a range.
    gpu::Range drawn(const OccluderRange& range) const
    {
        return {range.first_index, movers_shown_ ? range.inner_count : range.still_count};
    }
    /// The same with the hull.
    gpu::Range drawn_with_hull(const OccluderRange& range) const
    {
        return {range.first_index, movers_shown_ ? range.index_count : range.still_count};
    }

    const std::vector<Placement>& placements() const { return placements_; }  ///< [instances]
    const gpu::Array<Lumel>& lumels() const { return lumels_; }               ///< [N] in the world
    const gpu::Array<Piece>& pieces() const { return pieces_; }               ///< [P] in the world
    const gpu::Array<glm::vec3>& vertices() const { return vertices_; }       ///< [V] in the world
    const gpu::Array<glm::vec3>& looks() const { return looks_; }
    const gpu::Array<glm::vec2>& places() const { return places_; }  ///< [V] [texels], or none
    /// [V] corners of the rectangle that a vertex's chart fills there, low and high, or none
    const gpu::Array<glm::vec4>& charts() const { return charts_; }
    const gpu::Array<std::uint32_t>& indices() const { return indices_; }
    const OccluderRange& opaque() const { return opaque_; }
    const std::vector<CutOutDraw>& cut_outs() const { return cut_outs_; }
    /// True if there is coloured glass: views that carry one channel each are needed.
    bool has_coloured_glass() const { return coloured_glass_; }
    /// Bytes on the device.
    static std::uint64_t device_bytes(const Lumels& lumels, const Occluders& occluders);

    glm::vec3 low() const { return low_; }  ///< corners of the bounding box [m]
    glm::vec3 high() const { return high_; }
    const Sky& sky() const { return *sky_; }
    float diagonal() const { return glm::length(high_ - low_); }  ///< of the bounding box [m]

private:
    const gpu::Device* device_;
    const Sky* sky_;
    std::vector<Placement> placements_;
    gpu::Array<Placement> placement_array_;
    gpu::Array<Lumel> local_lumels_, lumels_;
    gpu::Array<Piece> local_pieces_, pieces_;
    gpu::Array<glm::vec3> local_vertices_, vertices_;
    gpu::Array<std::uint32_t> vertex_instances_;
    gpu::Array<glm::vec3> looks_;
    gpu::Array<glm::vec2> places_;
    gpu::Array<glm::vec4> charts_;
    gpu::Array<std::uint32_t> indices_;
    OccluderRange opaque_;
    std::vector<CutOutDraw> cut_outs_;
    bool coloured_glass_ = false;
    bool movers_shown_ = true;
    gpu::Kernel<shaders::WorldPlaceLumels> place_lumels_;
    gpu::Kernel<shaders::WorldPlaceVertices> place_vertices_;
    /// An instance's box, where it stood when that was found.
    struct Bounded {
        glm::mat4 transform;
        Box box;
    };
    std::vector<std::optional<Bounded>> bounded_;  ///< [instances]
    glm::vec3 low_{0.0f}, high_{0.0f};

    World(const gpu::Device& device, const Scene& scene, const Lumels& lumels,
          const Occluders& occluders);
};

}  // namespace lumel
