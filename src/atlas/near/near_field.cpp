#include "atlas/near/near_field.h"

#include <limits>
#include <span>

#include "atlas/near/near_factors.h"

namespace lumel {

NearField build_near_field(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                           const NearFieldOptions& options)
{
    const WorldLumels world(scene, rays, lumels);
    const float radius = fitting_radius(world, options.radius, options.most_pairs);
    const NearPairs pairs = find_near_pairs(world, lumels, radius);
    const std::vector<float> factors = near_factors(pairs, rays, world, lumels, options);

    NearField table;
    if (options.surroundings)
        table.around = find_surroundings(scene, rays, lumels);
    table.radius = radius;
    table.first.reserve(world.size() + 1);
    table.first.push_back(0);
    for (std::size_t i = 0; i < world.size(); ++i) {
        for (std::size_t k = pairs.first[i]; k < pairs.first[i + 1]; ++k)
            if (factors[k] >= kMinFactor) {
                table.column.push_back(pairs.partner_of(k));
                table.factor.push_back(factors[k]);
            }
        limit_row(std::span(table.factor).subspan(table.first.back()));
        table.first.push_back(std::uint32_t(table.column.size()));
    }
    return table;
}

std::uint64_t count_near_pairs(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                               const NearFieldOptions& options)
{
    const WorldLumels world(scene, rays, lumels);
    return find_near_pairs(world, lumels, fitting_radius(world, options.radius, options.most_pairs))
        .partner.size();
}

NearField build_near_field_among(const std::vector<char>& chosen, const Scene& scene,
                                 const RayScene& rays, const Lumels& lumels,
                                 NearFieldOptions options)
{
    // The others are marked as buried, so they have no partners.
    Lumels some = lumels;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (!chosen[i])
            some.lumels[i].flags |= kLumelBuried;
    options.most_pairs = std::numeric_limits<std::size_t>::max();
    return build_near_field(scene, rays, some, options);
}

}  // namespace lumel
