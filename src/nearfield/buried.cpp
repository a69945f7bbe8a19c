#include "nearfield/buried.h"

#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "nearfield/sequence.h"
#include "nearfield/world_lumels.h"

namespace lumel {

namespace {

constexpr std::uint32_t kFirstPoints = 8;  ///< all over a lumel, to see whether it is open
constexpr std::size_t kCornerPieces = 4;   ///< pieces whose corners are looked at first
constexpr float kInset = 0.02f;            ///< of corners, in parts of the piece or cell
constexpr int kCells = 8;                  ///< along each side of a lumel that is partly hidden
constexpr std::uint32_t kDirections = 16;  ///< per point
/// A lumel with less than this left open counts as buried: too little is seen of it to hold a value
/// of its own, and its neighbours' light fills it better.
constexpr float kLeastOpen = 0.1f;
/// A surface closer than this above a lumel, in the lumel's sizes, lies on it.
constexpr float kContact = 0.01f;
/// Blended surfaces are judged by one draw; which one does not matter.
constexpr std::uint32_t kBlendSeed = 0;

/// Cosine-distributed direction about unit normal n, for (s, t) in the unit square.
glm::vec3 direction_about(const glm::vec3& n, const glm::vec2& st)
{
    const glm::vec3 side = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(side, n));
    const glm::vec3 v = glm::cross(n, u);
    const float radius = std::sqrt(st.x);
    const float angle = 2.0f * std::numbers::pi_v<float> * st.y;
    const glm::vec3 flat = radius * (std::cos(angle) * u + std::sin(angle) * v);
    return glm::normalize(flat + std::sqrt(std::max(0.0f, 1.0f - st.x)) * n);
}

bool is_double_sided(const Scene& scene, const RayHit& hit)
{
    const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
    return scene.materials[mesh.primitives[hit.primitive].material].double_sided;
}

bool is_shut_in(const Scene& scene, const RayScene& rays, const WorldLumel& lumel,
                const LumelPoint& point, const glm::vec3& direction)
{
    RayHit hit;
    const glm::vec3 origin = point.position + lumel.lift * point.normal;
    if (!rays.closest(origin, direction, 0.0f, INFINITY, kBlendSeed, hit))
        return false;
    if (!hit.front && !is_double_sided(scene, hit))
        return true;
    return hit.distance * glm::dot(direction, point.normal) < kContact * lumel.size;
}

/// What everything below looks at.
struct Look {
    const Scene& scene;
    const RayScene& rays;
    const WorldLumels& world;
    const Lumels& lumels;
};

/// True if every ray of a point is shut in.
bool is_hidden(const Look& look, std::size_t i, const LumelPoint& point)
{
    for (std::uint32_t d = 0; d < kDirections; ++d) {
        const glm::vec2 st = sobol_pair(d, hash_two(std::uint32_t(i), 1));
        if (!is_shut_in(look.scene, look.rays, look.world[i], point,
                        direction_about(point.normal, st)))
            return false;
    }
    return true;
}

/// The same for a place on one of its pieces, in the world.
bool is_hidden(const Look& look, std::size_t i, const Piece& piece, const glm::vec2& uv)
{
    return is_hidden(look, i,
                     {piece.origin + uv.x * piece.edge_u + uv.y * piece.edge_v, piece.normal});
}

/// True if all of some first points of the lumel are open: points near the corners of its pieces,
/// where a neighbour would begin to cover it, and points all over.
bool looks_open(const Look& look, std::size_t i)
{
    const std::span<const Piece> pieces = look.world.pieces(look.world[i]);
    for (const Piece& piece : pieces.first(std::min(pieces.size(), kCornerPieces)))
        for (const glm::vec2& uv : {glm::vec2(kInset), glm::vec2(1.0f - 2.0f * kInset, kInset),
                                    glm::vec2(kInset, 1.0f - 2.0f * kInset),
                                    glm::vec2(piece.parallelogram ? 1.0f - kInset : 0.5f - kInset)})
            if (is_hidden(look, i, piece, uv))
                return false;
    for (std::uint32_t k = 0; k < kFirstPoints; ++k)
        if (is_hidden(look, i, look.world.point_on(i, sobol_pair(k, 0))))
            return false;
    return true;
}

/// Appends the parts of a piece that are open, in the lumel's frame: its cells in a side × side
/// grid (in a triangle, the cells of both orientations) whose corners and centre are all open.
void append_open_parts(const Look& look, std::size_t i, std::uint32_t index, int side,
                       std::vector<Piece>& parts)
{
    const Piece& piece = look.lumels.pieces[look.lumels.lumels[i].first_piece + index];
    const Piece& in_world = look.world.pieces(look.world[i])[index];
    const float step = 1.0f / float(side);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            if (piece.parallelogram == 0 && row + column >= side)
                continue;
            // On the diagonal of a triangle only half a cell is left.
            const bool whole = piece.parallelogram == 1 || row + column + 2 <= side;
            const glm::vec2 low = step * glm::vec2(float(column), float(row));
            const float most = whole ? 1.0f - kInset : 0.5f - kInset;
            bool open = true;
            for (const glm::vec2& uv :
                 {glm::vec2(kInset), glm::vec2(1.0f - 2.0f * kInset, kInset),
                  glm::vec2(kInset, 1.0f - 2.0f * kInset), glm::vec2(most), glm::vec2(0.5f * most)})
                open = open && !is_hidden(look, i, in_world, low + step * uv);
            if (open)
                parts.push_back({piece.origin + low.x * piece.edge_u + low.y * piece.edge_v,
                                 step * piece.edge_u, step * piece.edge_v, piece.normal, 0.0f,
                                 whole ? 1u : 0u});
        }
}

float local_area(const Piece& piece)
{
    return glm::length(glm::cross(piece.edge_u, piece.edge_v)) *
           (piece.parallelogram ? 1.0f : 0.5f);
}

/// What is left of a lumel that is partly hidden: its open pieces, with their shares, and the
/// share of the area that they are.
struct OpenPart {
    std::size_t lumel;
    std::vector<Piece> pieces;
    float share;
};

OpenPart find_open_part(const Look& look, std::size_t i)
{
    const Lumel& lumel = look.lumels.lumels[i];
    OpenPart part{i, {}, 0.0f};
    const int side = std::max(2, int(float(kCells) / std::sqrt(float(lumel.piece_count))));
    float whole = 0.0f, open = 0.0f;
    for (std::uint32_t k = 0; k < lumel.piece_count; ++k) {
        whole += local_area(look.lumels.pieces[lumel.first_piece + k]);
        append_open_parts(look, i, k, side, part.pieces);
    }
    for (Piece& piece : part.pieces)
        piece.share = open += local_area(piece);
    for (Piece& piece : part.pieces)
        piece.share /= open;
    part.share = whole > 0.0f ? open / whole : 0.0f;
    return part;
}

/// Makes the lumel its open part, or buries it.
void apply(Lumels& lumels, const OpenPart& part)
{
    Lumel& lumel = lumels.lumels[part.lumel];
    if (part.share < kLeastOpen) {
        lumel.flags |= kLumelBuried;
        return;
    }
    lumel.area *= part.share;
    lumel.first_piece = std::uint32_t(lumels.pieces.size());
    lumel.piece_count = std::uint32_t(part.pieces.size());
    lumels.pieces.insert(lumels.pieces.end(), part.pieces.begin(), part.pieces.end());
}

}  // namespace

void mark_buried(const Scene& scene, const RayScene& rays, Lumels& lumels)
{
    std::vector<OpenPart> parts(lumels.lumels.size());
    {
        const WorldLumels world(scene, rays, lumels);
        const Look look{scene, rays, world, lumels};
        parallel_for(world.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                parts[i] = looks_open(look, i) ? OpenPart{i, {}, 1.0f} : find_open_part(look, i);
        });
    }
    for (const OpenPart& part : parts)
        if (part.share < 1.0f)
            apply(lumels, part);
}

}  // namespace lumel
