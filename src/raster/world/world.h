#pragma once
// The scene and its lumels in GPU memory.

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

/// Units to measure first for a kind of work (see gpu::Pacer).
inline constexpr std::uint32_t kProbeLumels = 4096;

/// A cut-out material's part of the occluders, with its base colour on the GPU.
struct CutOutDraw {
    OccluderRange range;
    std::unique_ptr<gpu::Target> color;
    std::unique_ptr<gpu::Sampler> sampler;
    Passage passage{};
};

/// Local data are constant; world-space data follow the instances' transforms.
class World {
public:
    /// `scene`: its sky must outlive this. `atlas`: the lumels' atlas, or null if vertices need no
    /// atlas positions.
    World(const gpu::Device& device, const Scene& scene, const Lumels& lumels,
          const Atlas* atlas = nullptr, const std::vector<char>& movers = {});

    /// Sets the instances' transforms [instances]. Waits for the GPU.
    void place(std::span<const glm::mat4> transforms);

    /// Updates the bounding box, which views of sky and sun use, from the scene's transforms. Costs
    /// time for moved instances only.
    void bound(const Scene& scene);

    /// Shows movable instances in views, as initially, or hides them.
    void show_movers(bool shown) { movers_shown_ = shown; }
    /// Indices of a range that views draw.
    gpu::Range drawn(const OccluderRange& range) const
    {
        return {range.first_index, movers_shown_ ? range.inner_count : range.still_count};
    }
    /// Indices of a range that views draw, including the hull.
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
    /// [V] rectangle of the vertex's chart there, low and high corner, or none
    const gpu::Array<glm::vec4>& charts() const { return charts_; }
    const gpu::Array<std::uint32_t>& indices() const { return indices_; }
    const OccluderRange& opaque() const { return opaque_; }
    const std::vector<CutOutDraw>& cut_outs() const { return cut_outs_; }
    /// True if there is coloured glass: views with one channel each are needed.
    bool has_coloured_glass() const { return coloured_glass_; }
    /// GPU memory [bytes].
    static std::uint64_t device_bytes(const Lumels& lumels, const Atlas& atlas);

    glm::vec3 low() const { return low_; }  ///< bounding box [m]
    glm::vec3 high() const { return high_; }
    const Sky& sky() const { return *sky_; }
    float diagonal() const { return glm::length(high_ - low_); }  ///< bounding box diagonal [m]

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
    /// An instance's box, and the transform at which it was computed.
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
