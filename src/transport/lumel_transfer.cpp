// From light on patches to light on lumels.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Section 3.6,
//   step 4.
//
// The paper leaves this open. A lumel i would receive Σ_p F_ip B_p; its row F_i is much like the
// rows F_q of the patches around it. The weights are those with which these rows are most like it:
//
//     Σ_p (F_ip - Σ_q w_q F_qp)²  +  λ Σ_q (w_q - w⁰_q)²  →  min,
//
// w⁰ by distance and likeness. So patches behind a wall get no weight though they may be closest,
// and a lumel in a corner is distinguished from the middle of its patch. The sums are taken while
// the columns p are found: no row of a lumel is ever kept.

#include "transport/lumel_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"

namespace lumel {
namespace {

constexpr std::size_t kLumelsPerTask = 256;
/// Weights by distance fall by e over this part of a voxel's side.
constexpr float kReach = 0.6f;
/// Patches that face elsewhere are farther by this number of voxels times 1 - cosine.
constexpr float kTurn = 2.0f;
/// Those whose normals have a smaller cosine than this are no neighbours.
constexpr float kLeastAgreement = 0.5f;
/// λ, as a part of the mean of Σ_p F_qp².
constexpr float kFaith = 0.003f;
/// Holds the weights of excluded patches at 0, in the same measure.
constexpr float kIdle = 1e6f;

using Row = std::array<float, kTransferPatches>;

/// x of the symmetric positive definite a x = b, by Cholesky's factors.
Row solved(std::array<Row, kTransferPatches> a, Row b)
{
    constexpr std::size_t n = kTransferPatches;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k)
            for (std::size_t i = j; i < n; ++i)
                a[i][j] -= a[i][k] * a[j][k];
        const float root = std::sqrt(std::max(a[j][j], 1e-30f));
        for (std::size_t i = j; i < n; ++i)
            a[i][j] /= root;
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

struct Candidate {
    float distance;  ///< squared [voxels]
    std::uint32_t patch;
    bool operator<(const Candidate& other) const { return distance < other.distance; }
};

/// The nearest patches, nearest first; `own` takes the places that are left over.
std::array<Candidate, kTransferPatches> nearest(const VoxelPatches& patches,
                                                const glm::vec3& position, const glm::vec3& normal,
                                                std::uint32_t own)
{
    std::array<Candidate, kTransferPatches> found;
    found.fill({std::numeric_limits<float>::max(), own});
    for (std::uint32_t q = 0; q < patches.size(); ++q) {
        const VoxelPatch& patch = patches.patches[q];
        const glm::vec3 offset = (patch.centre - position) / patches.side;
        const float distance = glm::dot(offset, offset);
        if (distance >= found.back().distance && q != own)
            continue;
        const float agreement = glm::dot(patch.normal, normal);
        if (agreement < kLeastAgreement && q != own)
            continue;
        const float turned = kTurn * (1.0f - agreement);
        const Candidate candidate{q == own ? 0.0f : distance + turned * turned, q};
        if (candidate < found.back()) {
            found.back() = candidate;
            std::inplace_merge(found.begin(), found.end() - 1, found.end());
        }
    }
    return found;
}

}  // namespace

std::vector<glm::vec3> LumelTransfer::apply(std::span<const glm::vec3> incident) const
{
    std::vector<glm::vec3> light(patch.size() / kTransferPatches, glm::vec3(0.0f));
    parallel_for(light.size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t k = i * kTransferPatches; k < (i + 1) * kTransferPatches; ++k)
                light[i] += weight[k] * incident[patch[k]];
            light[i] = glm::max(light[i], glm::vec3(0.0f));
        }
    });
    return light;
}

LumelTransferFit::LumelTransferFit(const World& world, const Lumels& lumels,
                                   const VoxelPatches& patches)
    : count_(lumels.lumels.size()),
      patch_(count_ * kTransferPatches, 0),
      start_(count_ * kTransferPatches, 0.0f),
      products_(count_ * kTransferPatches, 0.0f),
      received_(count_, 0.0f)
{
    parallel_for(count_, kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t own = patches.patch_of[i];
            if (own == kPatchless)
                continue;
            const auto [position, normal] = placed(world, lumels.lumels[i]);
            const auto found = nearest(patches, position, normal, own);
            float sum = 0.0f;
            for (std::size_t k = 0; k < kTransferPatches; ++k) {
                const std::uint32_t q = found[k].patch;
                const glm::vec3 offset = (patches.patches[q].centre - position) / patches.side;
                const bool spare = k > 0 && q == own;
                const float weight =
                    spare ? 0.0f : std::exp(-glm::dot(offset, offset) / (kReach * kReach));
                patch_[i * kTransferPatches + k] = q;
                start_[i * kTransferPatches + k] = weight;
                sum += weight;
            }
            for (std::size_t k = 0; k < kTransferPatches; ++k)
                start_[i * kTransferPatches + k] /= std::max(sum, 1e-30f);
        }
    });
}

void LumelTransferFit::add(std::span<const float> lumels, std::span<const float> patches)
{
    parallel_for(count_, kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            received_[i] += lumels[i];
            if (lumels[i] == 0.0f)
                continue;
            for (std::size_t k = i * kTransferPatches; k < (i + 1) * kTransferPatches; ++k)
                products_[k] += lumels[i] * patches[patch_[k]];
        }
    });
}

/// Σ_p F_qp F_rp of pairs of patches.
class LumelTransferFit::Overlaps {
public:
    Overlaps(const SquareMatrix& form_factors, std::span<const std::uint32_t> patch)
    {
        for (std::size_t first = 0; first < patch.size(); first += kTransferPatches)
            for (std::size_t a = first; a < first + kTransferPatches; ++a)
                for (std::size_t b = a; b < first + kTransferPatches; ++b)
                    keys_.push_back(key(patch[a], patch[b]));
        std::sort(keys_.begin(), keys_.end());
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
        values_.resize(keys_.size());
        const std::size_t n = form_factors.size;
        parallel_for(keys_.size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                const auto row = form_factors.values.begin() + std::ptrdiff_t((keys_[k] >> 32) * n);
                const auto other =
                    form_factors.values.begin() + std::ptrdiff_t((keys_[k] & 0xffffffffu) * n);
                values_[k] = std::inner_product(row, row + std::ptrdiff_t(n), other, 0.0f);
            }
        });
    }

    float of(std::uint32_t q, std::uint32_t r) const
    {
        const auto at = std::lower_bound(keys_.begin(), keys_.end(), key(q, r));
        return values_[std::size_t(at - keys_.begin())];
    }

private:
    static std::uint64_t key(std::uint32_t q, std::uint32_t r)
    {
        return std::uint64_t(std::min(q, r)) << 32 | std::max(q, r);
    }

    std::vector<std::uint64_t> keys_;  ///< ascending
    std::vector<float> values_;
};

void LumelTransferFit::fit_lumel(std::size_t i, const Overlaps& overlaps,
                                 std::span<const float> sums, bool closed, float* weights) const
{
    const std::uint32_t* patch = &patch_[i * kTransferPatches];
    const float* start = &start_[i * kTransferPatches];
    const float* product = &products_[i * kTransferPatches];
    std::array<Row, kTransferPatches> system;
    float mean = 0.0f;
    for (std::size_t a = 0; a < kTransferPatches; ++a) {
        for (std::size_t b = 0; b < kTransferPatches; ++b)
            system[a][b] = overlaps.of(patch[a], patch[b]);
        mean += system[a][a] / float(kTransferPatches);
    }
    const float faith = kFaith * mean;
    if (faith <= 0.0f)
        return;
    Row wish;
    float wishes = 0.0f;
    for (std::size_t a = 0; a < kTransferPatches; ++a) {
        // The weight of this patch alone: 0 if it and the lumel see nothing in common.
        const float likeness = std::min(product[a] / std::max(system[a][a], 1e-30f), 1.0f);
        wish[a] = likeness * start[a];
        wishes += wish[a];
    }
    Row right;
    for (std::size_t a = 0; a < kTransferPatches; ++a) {
        const bool idle = wish[a] == 0.0f;
        system[a][a] += idle ? kIdle * mean : faith;
        right[a] = idle ? 0.0f : product[a] + faith * wish[a] / wishes;
    }
    const Row found = solved(system, right);
    float sum = 0.0f;
    for (std::size_t a = 0; a < kTransferPatches; ++a)
        sum += found[a] * sums[patch[a]];
    // Light that is the same everywhere is to arrive as it should.
    const float scale = sum > 0.0f ? (closed ? 1.0f : received_[i]) / sum : 1.0f;
    for (std::size_t a = 0; a < kTransferPatches; ++a)
        weights[a] = scale * found[a];
}

LumelTransfer LumelTransferFit::fit(const SquareMatrix& form_factors, std::span<const float> sums,
                                    std::span<const char> closed) const
{
    const Overlaps overlaps(form_factors, patch_);
    LumelTransfer transfer{patch_, std::vector<float>(patch_.size(), 0.0f)};
    parallel_for(count_, kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            fit_lumel(i, overlaps, sums, closed[i] != 0, &transfer.weight[i * kTransferPatches]);
    });
    return transfer;
}

}  // namespace lumel
