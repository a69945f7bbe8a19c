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

#include "core/error.h"
#include "matrix/bounces.h"
#include "solve/lumel_arrays.h"

namespace lumel {
namespace {

/// [n] 1 for patches without an open lumel.
std::vector<char> closed_patches(const VoxelPatches& patches, std::span<const char> open)
{
    std::vector<char> closed(patches.size(), open.empty() ? 0 : 1);
    for (std::size_t i = 0; i < open.size(); ++i)
        if (open[i] && patches.patch_of[i] != kPatchless)
            closed[patches.patch_of[i]] = 0;
    return closed;
}

std::vector<char> closed_lumels(std::size_t count, std::span<const char> open)
{
    std::vector<char> closed(count, 0);
    for (std::size_t i = 0; i < open.size(); ++i)
        closed[i] = open[i] ? 0 : 1;
    return closed;
}

template <class Field>
auto each_patch(const VoxelPatches& patches, Field field)
{
    std::vector<std::decay_t<decltype(std::declval<VoxelPatch>().*field)>> values;
    for (const VoxelPatch& patch : patches.patches)
        values.push_back(patch.*field);
    return values;
}

std::vector<float> sums_of_rows(const SquareMatrix& matrix)
{
    std::vector<float> sums;
    for (std::size_t row = 0; row < matrix.size; ++row) {
        double sum = 0.0;
        for (std::size_t column = 0; column < matrix.size; ++column)
            sum += double(matrix.values[row * matrix.size + column]);
        sums.push_back(float(sum));
    }
    return sums;
}

}  // namespace

std::vector<glm::vec3> Transport::indirect(const Lumels& lumels,
                                           std::span<const glm::vec3> direct) const
{
    return transfer.apply(multiply(bounces, patches.means(lumels, direct)));
}

TransportBuilder::TransportBuilder(const gpu::Device& device, const World& world,
                                   const Lumels& lumels, const NearField& near,
                                   const SolverOptions& options)
    : lumels_(&lumels),
      around_(near.around),
      bounces_(options.bounces > 0 ? options.bounces : kAllBounces),
      patches_(make_voxel_patches(world, lumels, around_, options.patches)),
      factors_(device, world, lumels, near, patches_, options),
      fit_(world, lumels, patches_)
{
}

void TransportBuilder::step()
{
    factors_.step([&](std::uint32_t patch, std::span<const float> received) {
        const SquareMatrix& matrix = factors_.matrix();
        std::vector<float> column;
        for (std::uint32_t row = 0; row < matrix.size; ++row)
            column.push_back(matrix.at(row, patch));
        fit_.add(received, column);
    });
}

Transport TransportBuilder::finish()
{
    Transport result;
    const SquareMatrix found = factors_.matrix();
    result.form_factors = factors_.take_matrix();
    result.check = balance(result.form_factors, each_patch(patches_, &VoxelPatch::area),
                           closed_patches(patches_, around_.open));
    result.transfer = fit_.fit(found, sums_of_rows(result.form_factors),
                               closed_lumels(lumels_->lumels.size(), around_.open));
    result.bounces = lumel::bounces(
        color_matrix(result.form_factors, each_patch(patches_, &VoxelPatch::color)), bounces_);
    result.patches = std::move(patches_);
    return result;
}

MatrixRadiosity::MatrixRadiosity(const gpu::Device& device, const World& world,
                                 const Lumels& lumels, const NearField& near,
                                 const SolverOptions& options, std::span<const glm::vec3> known)
    : lumels_(&lumels),
      black_(black(lumels)),
      direct_(device, world, black_, near, options, known)
{
    if (reflecting_area(lumels) > 0.0f)
        builder_.emplace(device, world, lumels, near, options);
}

std::uint64_t MatrixRadiosity::device_bytes(const SolveSize& size, const SolverOptions& options)
{
    return FormFactors::device_bytes(size, options) +
           StochasticRadiosity::device_bytes(size, options);
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
