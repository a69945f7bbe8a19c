// Radiosity by a matrix of form factors of all reflections.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.
//
//     cut the scene into patches                                 voxel_patches, section 3.2
//     F_ij, fraction of j's light that arrives at i              form_factors, Eq. (3)
//     F^c_ij = F_ij color_j                                      Eq. (5)
//     M = Σ_{h ≥ 1} (F^c)^h                                      Eq. (8), solve/matrix/bounces.h
//     and then for any light:
//         direct light, at every lumel
//         M × its mean over patches                              Eq. (8)
//         the last bounce, by the row of each lumel              lumel_rows, section 3.6
//
// Differs from the paper:
// - h = 0, direct light, does not go through patches: lumels store it.
// - All reflections at once, (I - F^c)^-1 - I, instead of the first k.
// - Reciprocity and row sums are enforced.
// - Emissive surfaces are direct light like all others, by shadow rays.

#include "methods/matrix/matrix.h"

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
MatrixRadiosity::MatrixRadiosity(const gpu::Device& device, const World& world,
                                 const SolveScene& scene, const Lumels& lumels,
                                 const NearField& near, const MatrixOptions& options,
                                 double target_error, std::span<const glm::vec3> known)
    : lumels_(&lumels),
      known_(known.begin(), known.end()),
      direct_(scene, options.seed, target_error, known),
      seed_(options.seed),
      gather_rays_(gather_rays(target_error))
{
    if (reflecting_area(lumels) > 0.0f)
        builder_.emplace(device, world, lumels, near, options.transport);
}

std::uint64_t MatrixRadiosity::device_bytes(const SolveSize& size, const MatrixOptions& options)
{
    return FormFactors::device_bytes(size, options.transport.views);
}

void MatrixRadiosity::step()
{
    if (!builder_) {
        direct_.step();
        return;
    }
    builder_->step();
    if (builder_->done()) {
        transport_ = builder_->finish();
        times_ = builder_->factors().times();
        longest_ = builder_->factors().longest_submission();
        builder_.reset();
    }
}

SolverState MatrixRadiosity::state() const
{
    return builder_ ? SolverState{} : direct_.state();
}

std::vector<glm::vec3> MatrixRadiosity::irradiance()
{
    std::vector<glm::vec3> light = direct_.irradiance();
    if (!transport_)
        return light;
    FinalGather last(direct_, transport_->indirect(*lumels_, light), gather_rays_, seed_);
    while (!last.done())
        last.step();
    add_light(light, last.irradiance());
    if (!known_.empty())
        add_light(light, transport_->indirect(*lumels_, known_));
    return light;
}

}  // namespace lumel
