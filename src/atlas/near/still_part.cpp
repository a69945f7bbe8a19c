#include "atlas/near/still_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "atlas/near/buried.h"
#include "base/core/error.h"

namespace lumel {
namespace {

/// Relative change of lengths allowed for a rigid move: transforms are floats.
constexpr float kStretch = 1e-3f;

float volume_of(const MovedBox& box)
{
    const glm::vec3 size = box.high - box.low;
    return size.x * size.y * size.z;
}

}  // namespace

Scene without(const Scene& scene, const std::vector<char>& movers)
{
    Scene still = scene;
    still.meshes.emplace_back();
    for (std::size_t i = 0; i < movers.size(); ++i)
        if (movers[i])
            still.instances[i].mesh = int(still.meshes.size()) - 1;
    return still;
}

Lumels make_lumels(const Scene& scene, const Atlas& atlas, const std::vector<char>& movers)
{
    Lumels lumels = make_lumels(scene, atlas);
    if (lumels.lumels.empty())
        throw Error(ErrorKind::input, scene.path, "has no surface that can receive light");
    const Scene still = without(scene, movers);
    const RayScene rays(still);
    const std::vector<Lumel> before = lumels.lumels;
    const std::vector<Piece> pieces = lumels.pieces;
    mark_buried(scene, rays, atlas, lumels);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!movers[before[i].instance])
            continue;
        Lumel& lumel = lumels.lumels[i];
        lumel = before[i];
        lumel.first_piece = std::uint32_t(lumels.pieces.size());
        const auto first = pieces.begin() + before[i].first_piece;
        lumels.pieces.insert(lumels.pieces.end(), first, first + before[i].piece_count);
    }
    return lumels;
}

MovedBox box_of(const Scene& scene, std::uint32_t instance, const glm::mat4& transform)
{
    MovedBox box{glm::vec3(std::numeric_limits<float>::max()),
                 glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Primitive& primitive : scene.meshes[scene.instances[instance].mesh].primitives)
        for (const glm::vec3& p : primitive.positions) {
            const glm::vec3 world(transform * glm::vec4(p, 1.0f));
            box.low = glm::min(box.low, world);
            box.high = glm::max(box.high, world);
        }
    return box;
}

std::vector<MovedBox> around(const MovedBox& before, const MovedBox& after)
{
    const MovedBox both{glm::min(before.low, after.low), glm::max(before.high, after.high)};
    if (volume_of(both) <= volume_of(before) + volume_of(after))
        return {both};
    return {before, after};
}

bool is_open(const Scene& scene, std::uint32_t instance)
{
    using Point = std::array<float, 3>;
    std::map<std::pair<Point, Point>, int> joins;  // directed edges; opposite ones cancel
    for (const Primitive& primitive : scene.meshes[scene.instances[instance].mesh].primitives) {
        if (scene.materials[primitive.material].double_sided)
            continue;
        for (std::size_t k = 0; k < primitive.indices.size(); ++k) {
            const std::size_t next = k % 3 == 2 ? k - 2 : k + 1;
            const glm::vec3 a = primitive.positions[primitive.indices[k]];
            const glm::vec3 b = primitive.positions[primitive.indices[next]];
            const Point from{a.x, a.y, a.z}, to{b.x, b.y, b.z};
            joins[std::pair<Point, Point>(std::min(from, to), std::max(from, to))] +=
                from < to ? 1 : -1;
        }
    }
    return std::any_of(joins.begin(), joins.end(), [](auto& edge) { return edge.second != 0; });
}

bool is_rigid(const glm::mat4& from, const glm::mat4& to)
{
    const glm::mat3 turn = glm::mat3(to) * glm::inverse(glm::mat3(from));
    const glm::mat3 square = glm::transpose(turn) * turn;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            if (!(std::abs(square[c][r] - (c == r ? 1.0f : 0.0f)) <= kStretch))
                return false;
    return glm::determinant(turn) > 0.0f;
}

}  // namespace lumel
