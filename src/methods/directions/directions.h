#pragma once
// Radiosity by global directions with stochastic depth buffering [TN11]. See directions.cpp.

#include <array>
#include <deque>

#include "gpu/pacer.h"
#include "methods/directions/directions.gather.comp.h"
#include "methods/directions/directions.shared.h"
#include "methods/directions/options.h"
#include "raster/parallel/illumination_maps.h"
#include "solve/shooting/iteration.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Gathers the light of all lumels along one global direction at a time.
class GlobalDirections final : public Solver {
public:
    /// `world` must hold the atlas. Throws Error{device} if the device does not support the layers.
    GlobalDirections(const gpu::Device& device, const World& world, const Lumels& lumels,
                     const DirectionsOptions& options, std::span<const glm::vec3> known = {});

    /// Upper bound on GPU memory [bytes], if the device does not limit images and arrays. Automatic
    /// slabs count as one.
    static std::uint64_t device_bytes(const SolveSize& size, const DirectionsOptions& options);

    void step() override;
    /// Takes emission and albedo from `lumels`, and the current sky. Waits for the device. Throws
    /// Error{input} unless the options have a leak.
    void relight(const Lumels& lumels);
    SolverState state() const override { return iteration_.state(); }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }
    std::uint32_t slabs() const { return maps_.slabs(); }  ///< slabs per direction

private:
    /// Directions of one half-solution on the device.
    struct Chunk {
        gpu::Array<ParallelView> views;
        gpu::Array<GlobalDirection> directions;
        std::uint32_t first;  ///< index in the half's sequence
    };

    const Chunk& chunk_of(std::uint32_t half, std::uint32_t index);
    Chunk make_chunk(std::uint32_t half, std::uint32_t first) const;
    void peel(const Chunk& chunk, std::uint32_t first_view);
    void gather(const Chunk& chunk, std::uint32_t first_view, std::uint32_t layer = 0,
                bool keep = false);

    DirectionsOptions options_;
    const gpu::Device* device_;
    const World* world_;
    IlluminationMaps maps_;
    std::uint32_t batch_;  ///< K, a power of two
    gpu::Kernel<shaders::DirectionsGather> gather_;
    gpu::Array<std::uint32_t> lumel_of_;  ///< [texels][2] lumel of each side, or kNoLumel
    gpu::Array<std::uint32_t> seen_;      ///< [K][N] peeled: the surface that each lumel sees
    gpu::Array<std::uint32_t> news_;      ///< [1] peeled: 1 if a layer shows a new surface
    std::uint32_t layers_ = 1;            ///< maximum number peeled so far
    std::array<std::deque<Chunk>, 2> chunks_;
    gpu::Array<SeenLight> seen_light_;  ///< [N]
    Iteration iteration_;
    gpu::Pacer pacer_;  ///< last member: its destructor waits for work that uses others
};

}  // namespace lumel
