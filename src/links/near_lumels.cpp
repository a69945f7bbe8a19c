#include "links/near_lumels.h"

#include <limits>

namespace lumel {
namespace {

/// Texels around a hit without a lumel that are searched for one.
constexpr int kNeighbours = 2;

}  // namespace

NearLumels::NearLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels)
    : lumels_(lumels),
      at_hits_(scene, atlas, lumels),
      by_side_(lumels_by_side(lumels))
{
}

std::uint32_t NearLumels::lumel(const RayHit& hit) const
{
    const std::vector<Lumel>& lumels = lumels_.lumels;
    const auto serves = [&](std::uint32_t j) {
        return j != kNoLumel && lumels[j].instance == hit.instance &&
               !(lumels[j].flags & kLumelBuried);
    };
    const std::uint32_t exact = at_hits_.lumel(hit);
    if (serves(exact))
        return exact;
    const glm::vec2 at = at_hits_.place(hit);
    const int width = lumels_.width, height = lumels_.height;
    std::uint32_t best = kNoLumel;
    float least = std::numeric_limits<float>::max();
    for (int dy = -kNeighbours; dy <= kNeighbours; ++dy)
        for (int dx = -kNeighbours; dx <= kNeighbours; ++dx) {
            const int x = int(at.x) + dx, y = int(at.y) + dy;
            if (x < 0 || x >= width || y < 0 || y >= height)
                continue;
            const std::uint32_t j =
                by_side_[2 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) +
                         (hit.front ? 0 : 1)];
            const glm::vec2 apart = glm::vec2(x, y) + 0.5f - at;
            if (serves(j) && glm::dot(apart, apart) < least) {
                least = glm::dot(apart, apart);
                best = j;
            }
        }
    return best;
}

}  // namespace lumel
