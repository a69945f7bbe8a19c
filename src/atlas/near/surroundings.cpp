#include "atlas/near/surroundings.h"

#include <algorithm>
#include <limits>

#include "atlas/near/hemisphere.h"
#include "atlas/near/sequence.h"
#include "atlas/near/world_lumels.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Rays of all lumels together, and per lumel: a thousandth of the scene then has at least a
/// thousand. Openings that all of them miss do not matter.
constexpr std::size_t kAllRays = 2'000'000, kMinRays = 16, kMaxRays = 256;
constexpr std::size_t kLumelsPerTask = 256;
/// Neighbours are joined if a segment between them is free at one of these heights, in sizes of the
/// larger lumel: a low segment could hit the surface itself if it is bent.
constexpr float kHeights[] = {0.05f, 0.5f};
bool meets_front(const LumelsInScene& look, std::uint32_t i, std::uint32_t ray)
{
    const LumelPoint x = look.world.point_on(i, sobol_pair(ray, hash_two(i, 0)));
    const glm::vec3 direction = direction_about(x.normal, sobol_pair(ray, hash_two(i, 1)));
    RayHit hit;
    if (!look.rays.closest(x.position + look.world[i].ray_offset * x.normal, direction, 0.0f,
                           std::numeric_limits<float>::max(), ray, hit))
        return false;
    return (hit.front || is_double_sided(look.scene, hit)) && hit.tint == glm::vec3(1.0f);
}

bool is_open(const LumelsInScene& look, std::uint32_t i)
{
    const std::size_t rays = std::clamp(kAllRays / look.lumels.lumels.size(), kMinRays, kMaxRays);
    for (std::uint32_t ray = 0; ray < rays; ++ray)
        if (!meets_front(look, i, ray))
            return true;
    return false;
}

bool are_joined(const LumelsInScene& look, std::uint32_t i, std::uint32_t j)
{
    const Lumel &a = look.lumels.lumels[i], &b = look.lumels.lumels[j];
    const std::uint32_t hidden = (a.flags | b.flags) & kLumelBuried;
    if (hidden || a.chart != b.chart)
        return false;
    const WorldLumel &x = look.world[i], &y = look.world[j];
    for (const float height : kHeights) {
        const float ray_offset = height * std::max(x.size, y.size);
        if (look.rays.sees(x.centre + ray_offset * x.normal, y.centre + ray_offset * y.normal, 0.0f,
                           kBlendSeed))
            return true;
    }
    return false;
}

}  // namespace

Surroundings find_surroundings(const Scene& scene, const RayScene& rays, const Lumels& lumels)
{
    const WorldLumels world(scene, rays, lumels);
    const LumelsInScene look{scene, rays, world, lumels};
    const std::vector<std::uint32_t> at = lumels_by_side(lumels);
    const auto joined = [&](std::uint32_t i, std::size_t texel, std::size_t side) {
        const std::uint32_t j = texel < at.size() / 2 ? at[2 * texel + side] : kNoLumel;
        return j != kNoLumel && are_joined(look, i, j) ? char(1) : char(0);
    };
    const std::size_t count = lumels.lumels.size();
    Surroundings result{std::vector<char>(count), std::vector<char>(count),
                        std::vector<char>(count)};
    parallel_for(count, kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (auto i = std::uint32_t(first); i < last; ++i) {
            const Lumel& lumel = lumels.lumels[i];
            const std::size_t side = (lumel.flags & kLumelBack) ? 1 : 0;
            const bool at_edge = (lumel.texel + 1) % std::uint32_t(lumels.width) == 0;
            result.open[i] = is_open(look, i) ? 1 : 0;
            result.joined_right[i] = at_edge ? char(0) : joined(i, lumel.texel + 1, side);
            result.joined_below[i] = joined(i, lumel.texel + std::size_t(lumels.width), side);
        }
    });
    return result;
}

}  // namespace lumel
