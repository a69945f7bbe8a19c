// Radiosity by a matrix of form factors of all reflections.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.
//
//     cut the scene into patches                                 voxel_patches, section 3.2
//     F_ij, what of j's light arrives at i                       form_factors, Eq. (3)
//     F^c_ij = F_ij color_j                                      Eq. (5)
//     M = Σ_{h ≥ 1} (F^c)^h                                      Eq. (8), matrix/bounces.h
//     and then for any light:
//         what arrives straight from it, at every lumel
//         M × its mean over patches                              Eq. (8)
//         from patches back to lumels                            lumel_transfer, section 3.6
//
// Differs from the paper:
// - h = 0, light that was not reflected yet, never goes through patches: lumels have it as it is.
// - All reflections at once, (I - F^c)^-1 - I, instead of the first k.
// - Reciprocity and row sums are enforced.
// - Emissive surfaces are direct light like all other, found by stochastic radiosity.

#include "solve/matrix.h"

#include <algorithm>

#include "shooting/lumel_arrays.h"

namespace lumel {
StochasticOptions direct_options(const MatrixOptions& options)
{
    return {.seed = options.seed, .views = options.transport.views};
}

MatrixRadiosity::MatrixRadiosity(const gpu::Device& device, const World& world,
                                 const Lumels& lumels, const NearField& near,
                                 const MatrixOptions& options, std::span<const glm::vec3> known)
    : lumels_(&lumels),
      black_(black(lumels)),
      direct_(device, world, black_, near, direct_options(options), known)
{
    if (reflecting_area(lumels) > 0.0f)
        builder_.emplace(device, world, lumels, near, options.transport);
}

std::uint64_t MatrixRadiosity::device_bytes(const SolveSize& size, const MatrixOptions& options)
{
    return FormFactors::device_bytes(size, options.transport.views) +
           StochasticRadiosity::device_bytes(size, direct_options(options));
}

void MatrixRadiosity::step()
{
    if (!builder_) {
        direct_.step();
        times_ = factor_times_;
        for (const auto& [stage, ms] : direct_.times())
            times_[stage] += ms;
        return;
    }
    builder_->step();
    if (builder_->done()) {
        transport_ = builder_->finish();
        times_ = factor_times_ = builder_->factors().times();
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
    // `known` light is reflected by the lumels' emission already.
    if (transport_)
        add_light(light, transport_->indirect(*lumels_, light));
    return light;
}

double MatrixRadiosity::longest_submission() const
{
    return std::max(longest_, direct_.longest_submission());
}

}  // namespace lumel
