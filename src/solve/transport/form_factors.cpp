// Form factors between patches.
//
//   [CG85]   M. Cohen, D. Greenberg. The Hemi-Cube. 1985.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Section 4.3.3.
//   [SF17]   A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Eq. (3).
//
// Each patch shoots a radiosity of 1 from all of its blocks of lumels, as in progressive radiosity.
// The light that a lumel receives is its form factor to the patch; the area-weighted mean over the
// lumels of a patch is an element of the matrix. Close lumels use the near field.
//
// A_i F_ij = A_j F_ji, and in a closed room Σ_j F_ij = 1. Replacing areas by points violates both
// slightly. With D diagonal and S = (A F + (A F)ᵀ) / 2, the matrix  A⁻¹ D S D  satisfies the first
// for any D; balance() finds the D that satisfies the second.
// is; balance() finds the D that satisfies the second.

#include "solve/transport/form_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/core/parallel.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

constexpr std::uint32_t kOne = 0x3f800000;  // 1.0f
constexpr std::size_t kFactorRowsPerTask = 32;
constexpr std::size_t kLumelsPerTask = 4096;
/// Balancing ends when relative differences of sums are below this, or after kMaxRounds rounds.
constexpr double kBalanced = 1e-6;
constexpr int kMaxRounds = 200;

std::vector<Patch> sorted_blocks(const Lumels& lumels, const VoxelPatches& patches)
{
    std::vector<Patch> blocks = make_blocks(lumels, patches.patch_of);
    std::stable_sort(blocks.begin(), blocks.end(), [&](const Patch& a, const Patch& b) {
        return patches.patch_of[a.first] < patches.patch_of[b.first];
    });
    return blocks;
}

std::vector<float> areas_of(const Lumels& lumels)
{
    std::vector<float> areas;
    for (const glm::vec4& surface : surfaces_of(lumels))
        areas.push_back(surface.a);
    return areas;
}

/// Replaces F by S_ij = (A_i F_ij + A_j F_ji) / 2. Returns the relative difference.
double make_symmetric(SquareMatrix& matrix, std::span<const float> area)
{
    const std::size_t n = matrix.size;
    std::vector<double> off(n, 0.0), all(n, 0.0);
    parallel_for(n, kFactorRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = i; j < n; ++j) {
                float& here = matrix.values[i * n + j];
                float& there = matrix.values[j * n + i];
                const float a = area[i] * here, b = area[j] * there;
                off[i] += double(std::abs(a - b)) * (i == j ? 0.5 : 1.0);
                all[i] += double(a + b) * 0.5;
                here = there = 0.5f * (a + b);
            }
    });
    const double sum = std::accumulate(all.begin(), all.end(), 0.0);
    return sum > 0.0 ? std::accumulate(off.begin(), off.end(), 0.0) / sum : 0.0;
}

/// Σ_j m_ij x_j [n]
std::vector<double> row_sums(const SquareMatrix& matrix, const std::vector<double>& x)
{
    const std::size_t n = matrix.size;
    std::vector<double> sums(n, 0.0);
    parallel_for(n, kFactorRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = 0; j < n; ++j)
                sums[i] += double(matrix.values[i * n + j]) * x[j];
    });
    return sums;
}

/// d_i with d_i Σ_j S_ij d_j = target_i.
std::vector<double> scales_for(const SquareMatrix& symmetric, const std::vector<double>& target)
{
    std::vector<double> scale(target.size(), 1.0);
    for (int round = 0; round < kMaxRounds; ++round) {
        const std::vector<double> sums = row_sums(symmetric, scale);
        double worst = 0.0;
        for (std::size_t i = 0; i < scale.size(); ++i) {
            const double found = scale[i] * sums[i];
            if (found <= 0.0)
                continue;
            worst = std::max(worst, std::abs(found / target[i] - 1.0));
            scale[i] *= std::sqrt(target[i] / found);
        }
        if (worst < kBalanced)
            break;
    }
    return scale;
}

}  // namespace

FormFactorCheck balance(SquareMatrix& form_factors, std::span<const float> area,
                        std::span<const char> closed)
{
    const std::size_t n = form_factors.size;
    FormFactorCheck check;
    std::vector<double> target = row_sums(form_factors, std::vector<double>(n, 1.0));
    for (std::size_t i = 0; i < n; ++i) {
        if (closed[i]) {
            const double off = target[i] - 1.0;
            check.row_sum += off * off;
            check.worst_row_sum = std::max(check.worst_row_sum, std::abs(off));
            ++check.closed;
        }
        target[i] = double(area[i]) * (closed[i] ? 1.0 : std::min(target[i], 1.0));
    }
    check.row_sum = std::sqrt(check.row_sum / double(std::max<std::size_t>(check.closed, 1)));
    check.reciprocity = make_symmetric(form_factors, area);
    const std::vector<double> scale = scales_for(form_factors, target);
    parallel_for(n, kFactorRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = 0; j < n; ++j)
                form_factors.values[i * n + j] *= float(scale[i] * scale[j] / double(area[i]));
    });
    return check;
}

FormFactors::FormFactors(const gpu::Device& device, const World& world, const Lumels& lumels,
                         const NearField& near, const VoxelPatches& patches,
                         const ViewOptions& options)
    : world_(&world),
      patches_(&patches),
      lumel_area_(areas_of(lumels)),
      count_(std::uint32_t(lumels.lumels.size())),
      near_radius_(near.radius),
      near_(near_columns(near)),
      blocks_(sorted_blocks(lumels, patches)),
      matrix_{std::uint32_t(patches.size()),
              std::vector<float>(patches.size() * patches.size(), 0.0f)},
      look_(device),
      receive_(device, std::uint32_t(options.projection)),
      views_(device, world, options.projection, std::uint32_t(options.hemicube),
             std::uint32_t(options.batch)),
      block_array_(device, view(blocks_)),
      column_of_(columns_of_blocks()),
      columns_(device, view(column_of_)),
      eyes_(device, views_.capacity()),
      shots_(device, views_.capacity()),
      sending_(device, count_),
      received_(device, std::size_t(views_.capacity()) * count_),
      open_column_(count_, 0.0f),
      pacer_(device)
{
    pacer_.work("prepare",
                [&](gpu::Commands& commands) { commands.fill(sending_.buffer(), kOne); });
}

std::uint64_t FormFactors::device_bytes(const SolveSize& size, const ViewOptions& options)
{
    const auto batch = std::uint32_t(options.batch);
    return EyeViews::device_bytes(options.projection, std::uint32_t(options.hemicube), batch) +
           batch * (sizeof(Eye) + sizeof(PatchShot)) +
           size.count() * (sizeof(glm::vec3) + batch * sizeof(float));
}

/// End of the batch that begins at block next_.
std::uint32_t FormFactors::batch_end() const
{
    return std::min(next_ + views_.capacity(), std::uint32_t(blocks_.size()));
}

/// For each block, the column of its batch that it adds to.
std::vector<std::uint32_t> FormFactors::columns_of_blocks() const
{
    std::vector<std::uint32_t> columns;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
        const bool fresh = block % views_.capacity() == 0;
        const bool same = !fresh && patches_->patch_of[blocks_[block].first] ==
                                        patches_->patch_of[blocks_[block - 1].first];
        columns.push_back(fresh ? 0 : columns.back() + (same ? 0 : 1));
    }
    return columns;
}

/// The near field by columns (patches) instead of rows (lumels).
FormFactors::NearColumns FormFactors::near_columns(const NearField& near) const
{
    NearColumns result;
    result.first.assign(patches_->size() + 1, 0);
    if (near.first.empty())
        return result;
    for (const std::uint32_t j : near.column)
        ++result.first[patches_->patch_of[j] + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    std::vector<std::size_t> next = result.first;
    result.lumel.resize(near.column.size());
    result.factor.resize(near.column.size());
    for (std::uint32_t i = 0; i < count_; ++i)
        for (std::uint32_t k = near.first[i]; k < near.first[i + 1]; ++k) {
            const std::size_t at = next[patches_->patch_of[near.column[k]]]++;
            result.lumel[at] = i;
            result.factor[at] = near.factor[k];
        }
    return result;
}

void FormFactors::shoot(std::uint32_t last)
{
    const std::uint32_t shots = last - next_;
    pacer_.work("select", [&](gpu::Commands& commands) {
        commands.fill(received_.buffer());
        commands.dispatch(
            look_,
            {.lumels = world_->lumels(), .blocks = block_array_, .eyes = eyes_, .shots = shots_},
            BlockParams{next_, shots}, shots);
    });
    views_.look_from(pacer_, eyes_, shots);
    pacer_.dispatch_parts("receive", count_, kProbeLumels, receive_,
                          {.lumels = world_->lumels(),
                           .pieces = world_->pieces(),
                           .views = {views_.image(), views_.sampler()},
                           .eyes = eyes_,
                           .shots = shots_,
                           .sending = sending_,
                           .columns = columns_,
                           .received = received_},
                          {.views = views_.layout(),
                           .lumels = count_,
                           .shots = shots,
                           .first_block = next_,
                           .near_radius = near_radius_});
    pacer_.finish();
}

void FormFactors::step(const Column& take)
{
    const std::uint32_t last = batch_end();
    shoot(last);
    const auto patch_of_block = [&](std::uint32_t block) {
        return patches_->patch_of[blocks_[block].first];
    };
    const std::size_t columns = column_of_[last - 1] + 1;
    std::vector<float> received(columns * count_);
    received_.buffer().download(received.data(), received.size() * sizeof(float));
    std::size_t column = 0;
    for (std::uint32_t first = next_, end = first; first < last; first = end, ++column) {
        const std::uint32_t patch = patch_of_block(first);
        while (end < last && patch_of_block(end) == patch)
            ++end;
        const float* found = &received[column * count_];
        parallel_for(count_, kLumelsPerTask, [&](std::size_t begin, std::size_t stop) {
            for (std::size_t i = begin; i < stop; ++i)
                open_column_[i] += found[i];
        });
        if (end < blocks_.size() && patch_of_block(end) == patch)
            break;
        complete(patch, open_column_, take);
        std::fill(open_column_.begin(), open_column_.end(), 0.0f);
    }
    next_ = last;
}

void FormFactors::complete(std::uint32_t patch, std::vector<float>& received, const Column& take)
{
    for (std::size_t k = near_.first[patch]; k < near_.first[patch + 1]; ++k)
        received[near_.lumel[k]] += near_.factor[k];
    const std::size_t n = matrix_.size;
    std::vector<double> sums(n, 0.0);
    for (std::size_t i = 0; i < count_; ++i)
        if (patches_->patch_of[i] != kPatchless)
            sums[patches_->patch_of[i]] += double(lumel_area_[i]) * double(received[i]);
    for (std::size_t row = 0; row < n; ++row)
        matrix_.values[row * n + patch] = float(sums[row] / double(patches_->patches[row].area));
    if (take)
        take(patch, received);
}

}  // namespace lumel
