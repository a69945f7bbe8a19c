#include "atlas/cells/near_lumels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lumel {
namespace {

/// Hits whose places are found before their lumels.
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

void NearLumels::find(std::span<const RayHit> hits, std::vector<std::uint32_t>& lumels) const
{
    lumels.assign(hits.size(), kNoLumel);
    std::array<glm::vec2, kTogether> places;
    for (std::size_t first = 0; first < hits.size(); first += kTogether) {
        const std::size_t count = std::min(hits.size() - first, kTogether);
        for (std::size_t n = 0; n < count; ++n)
            if (!std::isinf(hits[first + n].distance))
                places[n] = places_.place(hits[first + n]);
        for (std::size_t n = 0; n < count; ++n)
            if (!std::isinf(hits[first + n].distance))
                lumels[first + n] = own(places[n], hits[first + n]);
        for (std::size_t n = 0; n < count; ++n)
            if (lumels[first + n] == kNoLumel && !std::isinf(hits[first + n].distance))
                lumels[first + n] = lumel(places[n], hits[first + n]);
    }
}

std::uint32_t NearLumels::lumel(const glm::vec2& place, const RayHit& hit) const
{
    std::uint32_t best = own(place, hit);
    if (best != kNoLumel)
        return best;
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
