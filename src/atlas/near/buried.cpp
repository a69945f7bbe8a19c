#include "atlas/near/buried.h"

#include <cmath>

#include "atlas/near/hemisphere.h"
#include "atlas/near/sequence.h"
#include "atlas/near/world_lumels.h"
#include "base/core/parallel.h"

namespace lumel {

namespace {

/// Lumels per progress step, and minimum per task.
constexpr std::size_t kTestedPerStep = 8192, kTestedPerTask = 64;
constexpr std::uint32_t kFirstPoints = 8;  ///< over the whole lumel, to test whether it is open
constexpr std::size_t kCornerPieces = 4;   ///< pieces whose corners are tested first
constexpr float kFromEdges = 0.02f;  ///< inset of points from edges, relative to the piece or strip
constexpr int kStrips = 6;           ///< strips of a partly buried lumel
constexpr int kStripBisections = 4;  ///< for a strip's open end, to 1/32 of a sample distance
constexpr std::uint32_t kDirections = 16;  ///< rays per point
/// Minimum cosine of rays to the surface: openings below it are cracks.
constexpr float kMinCosine = 0.17f;
/// Minimum open share of a lumel that is not buried: less is too small to hold a value, and its
/// neighbours' light fills it better.
constexpr float kMinOpen = 0.1f;
/// A surface closer than this above a lumel, relative to its size, lies on it.
constexpr float kContact = 0.01f;

bool is_shut_in(const Scene& scene, const RayScene& rays, const WorldLumel& lumel,
                const LumelPoint& point, const glm::vec3& direction)
{
    RayHit hit;
    const glm::vec3 origin = point.position + lumel.ray_offset * point.normal;
    if (!rays.closest(origin, direction, 0.0f, INFINITY, kBlendSeed, hit))
        return false;
    if (!hit.front && !is_double_sided(scene, hit))
        return true;
    return hit.distance * glm::dot(direction, point.normal) < kContact * lumel.size;
}

/// Tests whether points of a lumel are hidden. Tries the last successful direction first.
class HiddenPoints {
public:
    HiddenPoints(const LumelsInScene& look, std::size_t i) : look_(look), lumel_(i) {}

    /// True if all rays from a point are blocked.
    bool operator()(const LumelPoint& point)
    {
        for (std::uint32_t k = 0; k < kDirections; ++k) {
            const std::uint32_t d = k == 0 ? last_ : k <= last_ ? k - 1 : k;
            glm::vec2 st = sobol_pair(d, hash_two(std::uint32_t(lumel_), 1));
            st.x *= 1.0f - kMinCosine * kMinCosine;  // the squared sine
            if (!is_shut_in(look_.scene, look_.rays, look_.world[lumel_], point,
                            direction_about(point.normal, st))) {
                last_ = d;
                return false;
            }
        }
        return true;
    }

    /// True if a world-space point on one of its pieces is hidden.
    bool operator()(const Piece& piece, const glm::vec2& uv)
    {
        return (*this)({piece.origin + uv.x * piece.edge_u + uv.y * piece.edge_v, piece.normal});
    }

private:
    const LumelsInScene& look_;
    std::size_t lumel_;
    std::uint32_t last_ = 0;
};

enum class Openness { open, partly, hidden };

/// Tests a few points: near the corners of its pieces, where neighbours begin to cover it, and over
/// the whole lumel.
Openness first_look(const LumelsInScene& look, std::size_t i)
{
    HiddenPoints is_hidden(look, i);
    bool any_open = false, any_hidden = false;
    const auto add = [&](bool hidden) {
        (hidden ? any_hidden : any_open) = true;
        return any_open && any_hidden;
    };
    for (std::uint32_t k = 0; k < kFirstPoints; ++k)
        if (add(is_hidden(look.world.point_on(i, sobol_pair(k, 0)))))
            return Openness::partly;
    const std::span<const Piece> pieces = look.world.pieces(look.world[i]);
    for (const Piece& piece : pieces.first(std::min(pieces.size(), kCornerPieces)))
        for (const glm::vec2& uv :
             {glm::vec2(kFromEdges), glm::vec2(1.0f - 2.0f * kFromEdges, kFromEdges),
              glm::vec2(kFromEdges, 1.0f - 2.0f * kFromEdges),
              glm::vec2(piece.parallelogram ? 1.0f - kFromEdges : 0.5f - kFromEdges)})
            if (add(is_hidden(piece, uv)))
                return Openness::partly;
    return any_open ? Openness::open : Openness::hidden;
}

/// Reduces a piece to its open part, in strips. `swapped`: strips are along v instead of u.
class Strips {
public:
    Strips(const LumelsInScene& look, std::size_t i, std::uint32_t index, int count)
        : is_hidden_(look, i),
          piece_(look.lumels.pieces[look.lumels.lumels[i].first_piece + index]),
          in_world_(look.world.pieces(look.world[i])[index]),
          count_(count)
    {
        // Strips run in the direction of more changes. In a parallelogram both grids have the same
        // points, in a triangle nearly so.
        open_ = grid(false);
        Grid turned{};
        for (int line = 0; line < count_; ++line)
            for (int k = 0; k < count_; ++k)
                turned[at(line, k)] = open_[at(k, line)];
        swapped_ = changes(turned) > changes(open_);
        if (swapped_)
            open_ = piece_.parallelogram ? turned : grid(true);
    }

    /// Appends the open part of each strip, in the lumel's frame.
    void append_open_parts(std::vector<Piece>& parts)
    {
        const float step = 1.0f / float(count_);
        for (int strip = 0; strip < count_; ++strip) {
            const float low = step * float(strip), middle = low + 0.5f * step;
            for (const auto& [begin, end] : open_runs(strip, middle))
                append_run(low, step, begin, end, parts);
        }
    }

private:
    /// [lines][points per line] true if open.
    using Grid = std::array<bool, std::size_t(kStrips) * kStrips>;
    static std::size_t at(int line, int k) { return std::size_t(line) * kStrips + std::size_t(k); }

    bool is_open(float along, float across, bool swapped)
    {
        return !is_hidden_(in_world_,
                           swapped ? glm::vec2(across, along) : glm::vec2(along, across));
    }

    /// Length of the piece along its strips, at a position across them.
    float length_at(float across) const { return piece_.parallelogram ? 1.0f : 1.0f - across; }

    Grid grid(bool swapped)
    {
        Grid open{};
        for (int line = 0; line < count_; ++line) {
            const float across = (float(line) + 0.5f) / float(count_);
            for (int k = 0; k < count_; ++k)
                open[at(line, k)] =
                    is_open(length_at(across) * (float(k) + 0.5f) / float(count_), across, swapped);
        }
        return open;
    }

    /// Number of changes between open and hidden along the grid's lines.
    int changes(const Grid& open) const
    {
        int changes = 0;
        for (int line = 0; line < count_; ++line)
            for (int k = 1; k < count_; ++k)
                changes += open[at(line, k)] != open[at(line, k - 1)];
        return changes;
    }

    /// Boundary between an open and a hidden point of a strip, by bisection.
    float edge_between(float open, float hidden, float across)
    {
        for (int step = 0; step < kStripBisections; ++step) {
            const float middle = 0.5f * (open + hidden);
            (is_open(middle, across, swapped_) ? open : hidden) = middle;
        }
        return 0.5f * (open + hidden);
    }

    /// Open intervals of a strip's centre line.
    std::vector<std::pair<float, float>> open_runs(int strip, float across)
    {
        const float length = length_at(across), step = length / float(count_);
        std::vector<std::pair<float, float>> runs;
        float before = kFromEdges * step;
        bool was_open = is_open(before, across, swapped_);
        float begin = 0.0f;
        for (int k = 0; k <= count_; ++k) {
            const float place = k < count_ ? (float(k) + 0.5f) * step : length - kFromEdges * step;
            const bool open = k < count_ ? open_[at(strip, k)] : is_open(place, across, swapped_);
            if (open && !was_open)
                begin = edge_between(place, before, across);
            else if (!open && was_open)
                runs.emplace_back(begin, edge_between(before, place, across));
            was_open = open;
            before = place;
        }
        if (was_open)
            runs.emplace_back(begin, length);
        return runs;
    }

    /// Appends an interval of a strip; at the long side of a triangle the strip ends in a triangle.
    void append_run(float low, float step, float begin, float end, std::vector<Piece>& parts) const
    {
        const float straight = piece_.parallelogram ? 1.0f : std::max(1.0f - low - step, 0.0f);
        if (begin < std::min(end, straight))
            parts.push_back(part(begin, low, std::min(end, straight) - begin, step, true));
        if (end > straight)
            parts.push_back(part(straight, low, step, step, false));
    }

    Piece part(float along, float across, float length, float width, bool parallelogram) const
    {
        const glm::vec2 origin = swapped_ ? glm::vec2(across, along) : glm::vec2(along, across);
        const glm::vec2 size = swapped_ ? glm::vec2(width, length) : glm::vec2(length, width);
        return {piece_.origin + origin.x * piece_.edge_u + origin.y * piece_.edge_v,
                size.x * piece_.edge_u,
                size.y * piece_.edge_v,
                piece_.normal,
                0.0f,
                parallelogram ? 1u : 0u};
    }

    HiddenPoints is_hidden_;
    const Piece& piece_;
    const Piece& in_world_;
    int count_;  ///< ≤ kStrips
    bool swapped_ = false;
    Grid open_{};
};

float local_area(const Piece& piece)
{
    return glm::length(glm::cross(piece.edge_u, piece.edge_v)) *
           (piece.parallelogram ? 1.0f : 0.5f);
}

/// The open pieces of a partly buried lumel, with their shares, and their share of the area.
struct OpenPart {
    std::size_t lumel;
    std::vector<Piece> pieces;
    float share;
};

OpenPart find_open_part(const LumelsInScene& look, std::size_t i)
{
    const Lumel& lumel = look.lumels.lumels[i];
    OpenPart part{i, {}, 0.0f};
    const int side = std::max(2, int(float(kStrips) / std::sqrt(float(lumel.piece_count))));
    float whole = 0.0f, open = 0.0f;
    for (std::uint32_t k = 0; k < lumel.piece_count; ++k) {
        whole += local_area(look.lumels.pieces[lumel.first_piece + k]);
        Strips(look, i, k, side).append_open_parts(part.pieces);
    }
    for (Piece& piece : part.pieces)
        piece.share = open += local_area(piece);
    for (Piece& piece : part.pieces)
        piece.share /= open;
    part.share = whole > 0.0f ? open / whole : 0.0f;
    return part;
}

/// Reduces the lumel to its open part, or buries it. Returns its open share.
float apply(Lumels& lumels, const OpenPart& part)
{
    Lumel& lumel = lumels.lumels[part.lumel];
    if (part.share < kMinOpen) {
        lumel.flags |= kLumelBuried;
        return 0.0f;
    }
    lumel.area *= part.share;
    lumel.first_piece = std::uint32_t(lumels.pieces.size());
    lumel.piece_count = std::uint32_t(part.pieces.size());
    lumels.pieces.insert(lumels.pieces.end(), part.pieces.begin(), part.pieces.end());
    return part.share;
}

}  // namespace

std::vector<float> mark_buried(const Scene& scene, const RayScene& rays, Lumels& lumels,
                               const std::vector<char>& chosen, const ProgressCallback& progress)
{
    std::vector<OpenPart> parts(lumels.lumels.size());
    {
        const WorldLumels world(scene, rays, lumels);
        const LumelsInScene look{scene, rays, world, lumels};
        const auto look_at = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                parts[i] = {i, {}, 1.0f};
                if (!chosen.empty() && !chosen[i])
                    continue;
                const Openness openness = first_look(look, i);
                if (openness == Openness::partly)
                    parts[i] = find_open_part(look, i);
                else if (openness == Openness::hidden)
                    parts[i].share = 0.0f;
            }
        };
        parallel_steps(world.size(), kTestedPerStep, kTestedPerTask, look_at,
                       [&](std::size_t done) {
                           notify(progress, double(done) / double(world.size()));
                           return true;
                       });
    }
    std::vector<float> shares;
    for (const OpenPart& part : parts)
        shares.push_back(part.share < 1.0f ? apply(lumels, part) : 1.0f);
    return shares;
}

}  // namespace lumel
