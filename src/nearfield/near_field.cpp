// Near pairs of lumels: exact polygon form factors × visible fraction, in compressed rows.
//
// For receiver i and shooter j, with points x of i and y of j,
//
//     F_ij = mean over x of F(x → polygon of j) × o_j × Σ w V(x, y) / Σ w,
//     w = cosθ_i cosθ_j / (|y - x|² + A_j / 4π)
//
// F(x → polygon) is Lambert's edge sum and has no noise. Only visibility V is sampled, and its mean
// is weighted by how much light would go that way; o_j is the opacity of a cut-out.

#include "nearfield/near_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "nearfield/near_pairs.h"
#include "nearfield/sequence.h"
#include "nearfield/world_lumels.h"

namespace lumel {

namespace {

/// Factors below this are not worth an entry.
constexpr float kLeastFactor = 1e-7f;
/// Points per receiver are limited by the sequence.
constexpr int kMostSamples = 256;

/// Fills the rows of one table.
class Builder {
public:
    Builder(const RayScene& rays, const WorldLumels& world, const NearFieldOptions& options)
        : rays_(rays),
          world_(world),
          options_(options),
          samples_(std::uint32_t(std::clamp(options.samples, 1, kMostSamples)))
    {
    }

    /// Spreads the points of receiver i, for factor() below.
    void spread(std::size_t i, std::vector<LumelPoint>& points) const
    {
        points.clear();
        if (options_.centre) {
            points.push_back({world_[i].centre, world_[i].normal});
            return;
        }
        const std::uint32_t key = hash_two(options_.seed, std::uint32_t(i));
        for (std::uint32_t k = 0; k < samples_; ++k)
            points.push_back(world_.point_on(i, sobol_pair(k, 0, key)));
    }

    /// F_ij × visible fraction.
    float factor(std::uint32_t i, std::uint32_t j, const std::vector<LumelPoint>& points) const
    {
        const std::uint32_t count = sample_count(world_[i], world_[j]);
        const std::uint32_t key = hash_two(hash_two(options_.seed, i), j);
        float whole = 0.0f, lit = 0.0f, weight = 0.0f, unclipped = 0.0f;
        for (std::uint32_t k = 0; k < count; ++k) {
            const LumelPoint& x = points[options_.centre ? 0 : k];
            if (k == 0 || !options_.centre)
                unclipped = seen_from(x, world_[j]);
            if (unclipped <= 0.0f)
                continue;
            whole += unclipped;
            const LumelPoint y = world_.point_on(j, sobol_pair(k, 1, key));
            const float w = kernel(x, y, world_[j]);
            if (w <= 0.0f)
                continue;
            weight += w;
            if (visible(x, world_[i], y, world_[j], key + k))
                lit += w;
        }
        if (weight <= 0.0f)
            return 0.0f;
        return whole / float(count) * world_[j].opacity * (lit / weight);
    }

private:
    std::uint32_t sample_count(const WorldLumel& i, const WorldLumel& j) const
    {
        const float size = std::max(i.size, j.size);
        const glm::vec3 way = j.centre - i.centre;
        const float distance2 = glm::dot(way, way) / (size * size);
        const std::uint32_t divisor = distance2 < 1.5f * 1.5f ? 1 : distance2 < 2.5f * 2.5f ? 2 : 4;
        return std::max(1u, samples_ / divisor);
    }

    float seen_from(const LumelPoint& x, const WorldLumel& j) const
    {
        float sum = 0.0f;
        for (const Facet* facet = world_.begin(j); facet != world_.end(j); ++facet)
            sum += polygon_form_factor(x.position, x.normal, facet->corner, facet->count);
        return sum;
    }

    static float kernel(const LumelPoint& x, const LumelPoint& y, const WorldLumel& j)
    {
        const glm::vec3 way = y.position - x.position;
        const float distance2 = glm::dot(way, way);
        const float cosines =
            std::max(0.0f, glm::dot(x.normal, way)) * std::max(0.0f, -glm::dot(y.normal, way));
        const float spread2 = j.size * j.size * float(0.25 / std::numbers::pi);
        return cosines / (std::max(distance2, 1e-30f) * (distance2 + spread2));
    }

    bool visible(const LumelPoint& x, const WorldLumel& i, const LumelPoint& y, const WorldLumel& j,
                 std::uint32_t seed) const
    {
        const float lift = std::min(i.lift, j.lift);
        return rays_.sees(x.position + lift * x.normal, y.position + lift * y.normal, lift, seed);
    }

    const RayScene& rays_;
    const WorldLumels& world_;
    const NearFieldOptions& options_;
    std::uint32_t samples_;
};

}  // namespace

bool is_near(const glm::vec3& centre_i, float size_i, const glm::vec3& centre_j, float size_j,
             float radius)
{
    const glm::vec3 way = centre_j - centre_i;
    const float reach = radius * std::max(size_i, size_j);
    return glm::dot(way, way) < reach * reach;
}

NearField build_near_field(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                           const NearFieldOptions& options)
{
    const WorldLumels world(scene, rays, lumels);
    const NearPairs pairs = find_near_pairs(world, lumels, options.radius);
    const Builder builder(rays, world, options);

    // Compute every pair in place, row by row.
    std::vector<float> factors(pairs.partner.size());
    parallel_for(world.size(), 32, [&](std::size_t begin, std::size_t end) {
        std::vector<LumelPoint> points;
        for (std::size_t i = begin; i < end; ++i) {
            if (pairs.first[i] == pairs.first[i + 1])
                continue;
            builder.spread(i, points);
            for (std::size_t k = pairs.first[i]; k < pairs.first[i + 1]; ++k)
                factors[k] = builder.factor(std::uint32_t(i), pairs.partner[k], points);
        }
    });

    // Keep what counts.
    NearField table;
    table.first.reserve(world.size() + 1);
    table.first.push_back(0);
    for (std::size_t i = 0; i < world.size(); ++i) {
        for (std::size_t k = pairs.first[i]; k < pairs.first[i + 1]; ++k)
            if (factors[k] >= kLeastFactor) {
                table.column.push_back(pairs.partner[k]);
                table.factor.push_back(factors[k]);
            }
        table.first.push_back(std::uint32_t(table.column.size()));
    }
    return table;
}

}  // namespace lumel
