// Near pairs of lumels: exact polygon form factors × visible fraction, in compressed rows.
//
// For receiver i and shooter j, with points x of i and y of j,
//
//     F_ij = mean over x of F(x → polygon of j) × o_j × Σ w V(x, y) / Σ w,
//     w = cosθ_i cosθ_j / (|y - x|² + s_j² / 4π),   s_j the size of j
//
// F(x → polygon) is Lambert's edge sum, averaged over Gauss points x, without noise. Only the
// visibility V is sampled, by one ray from each x to a stratified y; its mean is weighted by the
// unoccluded light. o_j is the opacity of a cut-out.

#include "atlas/near/near_factors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "atlas/near/sequence.h"
#include "base/core/parallel.h"

namespace lumel {

namespace {

/// Distance, in sizes of the larger lumel, beyond which pairs use half as many points per side.
constexpr float kDistant = 2.0f;

/// Distance, in sizes of the larger lumel, beyond which pairs use point samples: their kernel
/// varies little, and noise averages out over the many pairs.
constexpr float kPointwise = 4.0f;
/// Point pairs per NearFieldOptions::samples, up to kOnePoint and beyond.
constexpr int kPointPart = 8, kDistantPart = 16;
constexpr float kOnePoint = 6.0f;
/// Lumels with more facets (foliage, ornaments) are evaluated by a sample of them.
constexpr std::uint32_t kMaxFacets = 8;

/// Points of a receiver, for close pairs and for distant ones.
struct ReceiverPoints {
    std::vector<WeightedPoint> close;
    std::vector<WeightedPoint> distant;
    std::vector<WeightedPoint> torn;  ///< for pairs that are partly visible, if any
};

/// Computes the rows of one table.
class Builder {
public:
    Builder(const RayScene& rays, const WorldLumels& world, const Lumels& lumels,
            const NearFieldOptions& options)
        : rays_(rays),
          world_(world),
          lumels_(lumels),
          options_(options),
          close_(std::clamp(int(std::sqrt(float(options.samples))), 1, kMaxSide)),
          distant_((close_ + 1) / 2),
          torn_(std::min(2 * close_, kMaxSide))
    {
    }

    ReceiverPoints spread(std::size_t i) const
    {
        return {spread(i, close_), spread(i, distant_), {}};
    }

    /// True if the pair uses pointwise(), which is symmetric.
    bool is_pointwise(std::uint32_t i, std::uint32_t j) const
    {
        const float size = std::max(world_[i].size, world_[j].size);
        return !is_near(world_[i].centre, size, world_[j].centre, size, kPointwise);
    }

    /// Mean of V cosθ_i cosθ_j / πr² over a few pairs of points [1/m²]: F_ij is this × A_j.
    float pointwise(std::uint32_t i, std::uint32_t j) const
    {
        const std::uint32_t key = hash_two(hash_two(options_.seed, i), j);
        const float size = std::max(world_[i].size, world_[j].size);
        const bool is_distant = !is_near(world_[i].centre, size, world_[j].centre, size, kOnePoint);
        const int samples =
            std::max(options_.samples / (is_distant ? kDistantPart : kPointPart), 1);
        float sum = 0.0f;
        for (int k = 0; k < samples; ++k) {
            // Every second pair mirrors the previous one about the lumels' centres.
            const bool opposite = k % 2 == 1;
            const glm::vec2 s = sobol_pair(std::uint32_t(k / 2), key);
            const glm::vec2 t = sobol_pair(std::uint32_t(k / 2), hash_two(key, 1));
            const glm::vec2 one(1.0f);
            const LumelPoint x = options_.centre ? LumelPoint{world_[i].centre, world_[i].normal}
                                                 : world_.point_on(i, opposite ? one - s : s);
            const LumelPoint y = world_.point_on(j, opposite ? one - t : t);
            const glm::vec3 offset = y.position - x.position;
            const float toward_j = glm::dot(x.normal, offset),
                        toward_i = -glm::dot(y.normal, offset);
            if (toward_j <= 0.0f || toward_i <= 0.0f ||
                !visible(x, world_[i], y, world_[j], key + std::uint32_t(k)))
                continue;
            const float distance2 = glm::dot(offset, offset);
            sum += toward_j * toward_i / (distance2 * distance2);
        }
        return sum / (float(samples) * std::numbers::pi_v<float>);
    }

    /// F_ij × visible fraction. Uses more points if the shooter is partly visible.
    float factor(std::uint32_t i, std::uint32_t j, ReceiverPoints& receiver) const
    {
        if (is_pointwise(i, j))  // make_reciprocal copies it to the higher index
            return i < j || options_.centre ? pointwise(i, j) * lumels_.lumels[j].area : 0.0f;
        const float size = std::max(world_[i].size, world_[j].size);
        const bool is_close = is_near(world_[i].centre, size, world_[j].centre, size, kDistant);
        const Sample first = sample(i, j, is_close ? receiver.close : receiver.distant);
        if (!first.torn)
            return first.whole * first.visible;
        return first.whole * torn_fraction(i, j, receiver, is_close);
    }

    /// F_ij with the maximum number of points, for partly visible pairs.
    float torn_factor(std::uint32_t i, std::uint32_t j) const
    {
        const Sample best = sample(i, j, spread(i, torn_));
        return best.whole * best.visible;
    }

private:
    struct Sample {
        float whole;    ///< unoccluded F_ij
        float visible;  ///< visible fraction of it
        bool torn;      ///< visible from some of the points only
    };

    /// Weighted visibility between a pair's points.
    struct Seen {
        float lit = 0.0f;
        float looked_at = 0.0f;
        float fraction() const { return looked_at > 0.0f ? lit / looked_at : 0.0f; }
    };

    /// Visible fraction, from more points.
    float torn_fraction(std::uint32_t i, std::uint32_t j, ReceiverPoints& receiver,
                        bool is_close) const
    {
        if (is_close && receiver.torn.empty())
            receiver.torn = spread(i, torn_);
        const std::vector<WeightedPoint>& points = is_close ? receiver.torn : receiver.close;
        Seen seen;
        for (std::uint32_t k = 0; k < points.size(); ++k)
            look(i, j, points[k], k, seen);
        return seen.fraction();
    }

    /// Tests the k-th point of i against one of j. Returns true if it is visible.
    bool look(std::uint32_t i, std::uint32_t j, const WeightedPoint& from, std::uint32_t k,
              Seen& seen) const
    {
        const std::uint32_t key = hash_two(hash_two(options_.seed, i), j);
        const LumelPoint y = world_.point_on(j, sobol_pair(k, key));
        const float weight = from.weight * kernel(from.point, y, world_[j]);
        const bool is_seen = weight > 0.0f && visible(from.point, world_[i], y, world_[j], key + k);
        seen.looked_at += weight;
        seen.lit += is_seen ? weight : 0.0f;
        return is_seen;
    }

    Sample sample(std::uint32_t i, std::uint32_t j, const std::vector<WeightedPoint>& points) const
    {
        float whole = 0.0f, unoccluded = 0.0f;
        bool some = false, all = true;
        Seen seen;
        for (std::uint32_t k = 0; k < points.size(); ++k) {
            if (k == 0 || !options_.centre)
                unoccluded = seen_from(points[k].point, world_[j], k);
            whole += points[k].weight * unoccluded;
            const bool is_seen = unoccluded > 0.0f && look(i, j, points[k], k, seen);
            some |= is_seen;
            all &= is_seen;
        }
        return {whole * world_[j].opacity, seen.fraction(), some && !all};
    }

    std::vector<WeightedPoint> spread(std::size_t i, int side) const
    {
        return options_.centre ? world_.centroids(i, side) : world_.gauss_points(i, side);
    }

    /// F(x → polygons of j). Of many polygons, a sample by area that depends on k.
    float seen_from(const LumelPoint& x, const WorldLumel& j, std::uint32_t k) const
    {
        const auto form_factor = [&x](const Facet& facet) {
            return polygon_form_factor(x.position, x.normal, facet.corner, facet.count);
        };
        if (j.facet_count <= kMaxFacets)
            return std::accumulate(
                world_.begin(j), world_.end(j), 0.0f,
                [&](float sum, const Facet& facet) { return sum + form_factor(facet); });

        const std::span<const Piece> pieces = world_.pieces(j);
        const float start = sobol_pair(k % 256, j.first_facet).x;
        float sum = 0.0f;
        for (std::uint32_t pick = 0; pick < kMaxFacets; ++pick) {
            const float at = (float(pick) + start) / float(kMaxFacets);
            const auto piece = std::upper_bound(
                pieces.begin(), pieces.end() - 1, at,
                [](float share, const Piece& candidate) { return share < candidate.share; });
            const float below = piece == pieces.begin() ? 0.0f : (piece - 1)->share;
            sum += form_factor(world_.begin(j)[piece - pieces.begin()]) / (piece->share - below);
        }
        return sum / float(kMaxFacets);
    }

    static float kernel(const LumelPoint& x, const LumelPoint& y, const WorldLumel& j)
    {
        const glm::vec3 offset = y.position - x.position;
        const float distance2 = glm::dot(offset, offset);
        const float cosines = std::max(0.0f, glm::dot(x.normal, offset)) *
                              std::max(0.0f, -glm::dot(y.normal, offset));
        const float softening = j.size * j.size * float(0.25 / std::numbers::pi);
        return cosines / (std::max(distance2, 1e-30f) * (distance2 + softening));
    }

    bool visible(const LumelPoint& x, const WorldLumel& i, const LumelPoint& y, const WorldLumel& j,
                 std::uint32_t seed) const
    {
        const float ray_offset = std::min(i.ray_offset, j.ray_offset);
        return rays_.sees(x.position + ray_offset * x.normal, y.position + ray_offset * y.normal,
                          ray_offset, seed);
    }

    const RayScene& rays_;
    const WorldLumels& world_;
    const Lumels& lumels_;
    const NearFieldOptions& options_;
    const int close_, distant_, torn_;  ///< points per side of a lumel
};

/// Enforces A_i F_ij = A_j F_ji by averaging the two estimates, which halves their noise. Flat
/// lumels only: with varying shading normals, irradiance is not exactly reciprocal. Pointwise pairs
/// have one estimate for both.
void make_reciprocal(const Builder& builder, const WorldLumels& world, const Lumels& lumels,
                     const NearPairs& pairs, std::vector<float>& factors)
{
    const auto average = [&](std::uint32_t i, std::uint32_t j, float& ij, float& ji) {
        if (builder.is_pointwise(i, j)) {
            const float back = lumels.lumels[j].area;
            ji = back > 0.0f ? ij * lumels.lumels[i].area / back : 0.0f;
            return;
        }
        if (!world[i].flat || !world[j].flat)
            return;
        // If only one estimate is positive, repeats the other with more points.
        if (ij <= 0.0f && ji > 0.0f)
            ij = builder.torn_factor(i, j);
        else if (ji <= 0.0f && ij > 0.0f)
            ji = builder.torn_factor(j, i);
        const float area_i = lumels.lumels[i].area, area_j = lumels.lumels[j].area;
        const float exchange = 0.5f * (area_i * ij + area_j * ji);
        ij = area_i > 0.0f ? exchange / area_i : 0.0f;
        ji = area_j > 0.0f ? exchange / area_j : 0.0f;
    };
    parallel_for(pairs.rows(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t k = pairs.middle[row]; k < pairs.first[row + 1]; ++k)
                average(pairs.lumel[row], pairs.partner_of(k), factors[k],
                        factors[pairs.mirror[k]]);
    });
}

}  // namespace

std::vector<float> near_factors(const NearPairs& pairs, const RayScene& rays,
                                const WorldLumels& world, const Lumels& lumels,
                                const NearFieldOptions& options)
{
    const Builder builder(rays, world, lumels, options);
    // Computes all pairs, row by row.
    std::vector<float> factors(pairs.partner.size());
    parallel_for(pairs.rows(), 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            if (pairs.first[row] == pairs.first[row + 1])
                continue;
            ReceiverPoints points = builder.spread(pairs.lumel[row]);
            for (std::size_t k = pairs.first[row]; k < pairs.first[row + 1]; ++k)
                factors[k] = builder.factor(pairs.lumel[row], pairs.partner_of(k), points);
        }
    });
    if (!options.centre)
        make_reciprocal(builder, world, lumels, pairs, factors);
    return factors;
}

bool limit_row(std::span<float> row)
{
    const float sum = std::accumulate(row.begin(), row.end(), 0.0f);
    if (!(sum > 1.0f))
        return false;
    for (float& factor : row)
        factor /= sum;
    return true;
}

}  // namespace lumel
