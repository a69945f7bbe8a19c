#include "atlas/cells/order.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "atlas/packing/morton.h"
#include "base/core/frame.h"

namespace lumel {
namespace {

/// Cells of the scene along each axis, within which lumels are sorted by the direction they face.
constexpr double kOrderCells = 32.0;

}  // namespace

std::vector<std::uint32_t> order_in_space(const WorldLumels& world)
{
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < world.size(); ++i) {
        low = glm::min(low, world[i].centre);
        high = glm::max(high, world[i].centre);
    }
    const double side = std::max(double(glm::distance(low, high)), 1e-30);
    struct Key {
        std::uint64_t cell, side, fine;
        std::uint32_t lumel;
        bool operator<(const Key& other) const
        {
            return std::tie(cell, side, fine, lumel) <
                   std::tie(other.cell, other.side, other.fine, other.lumel);
        }
    };
    std::vector<Key> keys(world.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
        const glm::dvec3 at = glm::dvec3(world[i].centre - low) / side;
        keys[i] = {morton_code(glm::floor(at * kOrderCells) / kOrderCells),
                   std::uint64_t(cube_side(world[i].normal)), morton_code(at), std::uint32_t(i)};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(world.size());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](const Key& key) { return key.lumel; });
    return order;
}

}  // namespace lumel
