#include "atlas/cells/near_lumels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lumel {
namespace {

/// Hits per pass of find().
constexpr std::size_t kTogether = 64;

}  // namespace

NearLumels::NearLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels)
    : places_(scene, atlas, lumels),
      width_(lumels.width),
      height_(lumels.height),
      by_side_(2 * std::size_t(width_) * std::size_t(height_))
{
    const std::vector<std::uint32_t> all = lumels_by_side(lumels);
    for (std::size_t n = 0; n < all.size(); ++n)
        if (all[n] != kNoLumel && !(lumels.lumels[all[n]].flags & kLumelBuried))
            by_side_[n] = {all[n], lumels.lumels[all[n]].instance};
}

std::uint32_t NearLumels::at(int x, int y, const RayHit& hit) const
{
    const std::size_t texel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
    const Entry& entry = by_side_[2 * texel + (hit.front ? 0 : 1)];
    return entry.instance == hit.instance ? entry.lumel : kNoLumel;
}

std::uint32_t NearLumels::own(const glm::vec2& place, const RayHit& hit) const
{
    return at(std::clamp(int(place.x), 0, width_ - 1), std::clamp(int(place.y), 0, height_ - 1),
              hit);
}

std::uint32_t NearLumels::lumel(const RayHit& hit) const
{
    const glm::vec2 place = places_.place(hit);
    const std::uint32_t found = own(place, hit);
    return found != kNoLumel ? found : nearest(place, hit);
}

void NearLumels::find(std::span<const RayHit> hits, std::vector<std::uint32_t>& lumels) const
{
    lumels.assign(hits.size(), kNoLumel);
    std::array<std::uint32_t, kTogether> number;
    std::array<glm::vec2, kTogether> place;
    for (std::size_t first = 0; first < hits.size(); first += kTogether) {
        std::size_t count = 0;
        for (std::size_t n = first; n < std::min(first + kTogether, hits.size()); ++n)
            if (!std::isinf(hits[n].distance)) {
                number[count] = std::uint32_t(n);
                place[count++] = places_.place(hits[n]);
            }
        for (std::size_t k = 0; k < count; ++k)
            lumels[number[k]] = own(place[k], hits[number[k]]);
        for (std::size_t k = 0; k < count; ++k)
            if (lumels[number[k]] == kNoLumel)
                lumels[number[k]] = nearest(place[k], hits[number[k]]);
    }
}

std::uint32_t NearLumels::nearest(const glm::vec2& place, const RayHit& hit) const
{
    std::uint32_t best = kNoLumel;
    float least = std::numeric_limits<float>::max();
    for (int y = std::max(int(place.y) - kHitReach, 0);
         y <= std::min(int(place.y) + kHitReach, height_ - 1); ++y)
        for (int x = std::max(int(place.x) - kHitReach, 0);
             x <= std::min(int(place.x) + kHitReach, width_ - 1); ++x) {
            const std::uint32_t j = at(x, y, hit);
            const glm::vec2 apart = glm::vec2(x, y) + 0.5f - place;
            if (j != kNoLumel && glm::dot(apart, apart) < least) {
                least = glm::dot(apart, apart);
                best = j;
            }
        }
    return best;
}

}  // namespace lumel
