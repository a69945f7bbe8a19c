#pragma once
// Batches of shooting patches, for progressive, incremental and cross-redistribution radiosity.

#include "gpu/pacer.h"
#include "raster/eyes/eye_views.h"
#include "raster/eyes/view_options.h"
#include "raster/near/near_rows.h"
#include "solve/solver/solve_size.h"
#include "solve/transport/patch_shots.shared.h"
#include "solve/transport/patch_shots.take.comp.h"
#include "solve/transport/patches.h"

namespace lumel {

/// Light of a solution. Invariant: H = T B^s, received light is that of the shot radiosity.
struct ShotLight {
    ShotLight(const gpu::Device& device, const Lumels& lumels);

    static std::uint64_t device_bytes(std::size_t lumel_count);

    gpu::Array<glm::vec4> surface;    ///< [N] ρ, A; A = 0 for buried lumels
    gpu::Array<glm::vec3> emission;   ///< [N] E
    gpu::Array<glm::vec3> shot;       ///< [N] B^s
    gpu::Array<glm::vec3> far, near;  ///< [N] H of the shot light, without and from close pairs
};

/// Patches of the lumels, and the current batch of them: chosen, taken, rendered from.
class PatchShots {
public:
    /// seed: of the points at which lumels receive; patches shoot from the same ones.
    PatchShots(const gpu::Device& device, const World& world, const Lumels& lumels,
               const ViewOptions& options, std::uint32_t seed);

    static std::uint64_t device_bytes(const SolveSize& size, const ViewOptions& options);

    /// Computes eyes, shots and sending radiosities of the patches in chosen(). ambient: [1] light
    /// still to arrive [lx], for patches that send unshot light.
    void take(gpu::Commands& commands, const ShotLight& light,
              const gpu::Array<glm::vec3>& ambient);
    /// Takes the batch that begins at `first` in a list of whole batches, without light still to
    /// arrive.
    void take(gpu::Commands& commands, const ShotLight& light, const gpu::Array<ChosenPatch>& list,
              std::uint32_t first);
    /// Renders their views.
    void look(gpu::Pacer& pacer) { views_.look_from(pacer, eyes_, batch_); }

    std::uint32_t batch() const { return batch_; }  ///< K
    const Patches& layout() const { return layout_; }
    const gpu::Array<PatchChart>& charts() const { return charts_; }   ///< [C]
    gpu::Array<std::uint32_t>& levels() { return levels_; }            ///< [C] current level
    gpu::Array<ChosenPatch>& chosen() { return chosen_; }              ///< [K]
    const gpu::Array<Eye>& eyes() const { return eyes_; }              ///< [K]
    const gpu::Array<PatchShot>& shots() const { return shots_; }      ///< [K]
    const gpu::Array<glm::vec3>& sending() const { return sending_; }  ///< [N]
    const EyeViews& views() const { return views_; }

private:
    const World* world_;
    gpu::Kernel<shaders::PatchShotsTake> take_;
    EyeViews views_;
    std::uint32_t batch_;
    std::uint32_t first_number_;  ///< of points
    Patches layout_;
    gpu::Array<Patch> patches_;
    gpu::Array<PatchChart> charts_;
    gpu::Array<std::uint32_t> levels_;
    gpu::Array<ChosenPatch> chosen_;
    gpu::Array<Eye> eyes_;
    gpu::Array<PatchShot> shots_;
    gpu::Array<glm::vec3> sending_;     ///< fraction of its light that a point of this batch sends
    gpu::Array<glm::vec3> no_ambient_;  ///< [1] 0
};

/// Pads the list with empty entries to a multiple of `batch`, at least one batch.
std::vector<ChosenPatch> in_whole_batches(std::vector<ChosenPatch> list, std::uint32_t batch);

}  // namespace lumel
