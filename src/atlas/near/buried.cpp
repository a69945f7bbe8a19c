#include "atlas/near/buried.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "atlas/near/hidden_points.h"
#include "atlas/near/sequence.h"
#include "atlas/near/world_lumels.h"
#include "base/ranks/rank_blocks.h"

namespace lumel {

namespace {

/// Lumels per block, and blocks per progress step and rank.
constexpr std::size_t kBlock = 64, kBlocksPerStep = 128;
constexpr std::uint32_t kFirstPoints = 8;  ///< over the whole lumel, to test whether it is open
constexpr std::size_t kCornerPieces = 4;   ///< pieces whose corners are tested first
constexpr float kFromEdges = 0.02f;  ///< inset of points from edges, relative to the piece or strip
constexpr int kStrips = 6;           ///< strips of a partly buried lumel
constexpr int kStripBisections = 4;  ///< for a strip's open end, to 1/32 of a sample distance
/// Minimum open share of a lumel that is not buried: less is too small to hold a value, and its
/// neighbours' light fills it better.
constexpr float kMinOpen = 0.1f;

enum class Openness { open, partly, hidden };

struct FirstLook {
    Openness openness;
    Directions successful;  ///< of rays from its points
    bool is_near_back;      ///< many of them hit backs nearby
};

/// Tests a few points: near the corners of its pieces, where neighbours begin to cover it, and over
/// the whole lumel; one point of a lumel that nothing is near.
FirstLook first_look(const LumelsInScene& look, const InnerSides& inner, std::size_t i)
{
    constexpr std::size_t kMostPoints = kFirstPoints + kCornersOfPiece * kCornerPieces;
    std::array<LumelPoint, kMostPoints> points;
    std::array<bool, kMostPoints> hidden;
    std::size_t count = 0;
    const bool is_clear = look.world.is_clear(i, look.rays);
    if (is_clear)
        points[count++] = {look.world[i].centre, look.world[i].normal};
    else
        for (std::uint32_t k = 0; k < kFirstPoints; ++k)
            points[count++] = look.world.point_on(i, sobol_pair(k, 0));
    const std::size_t first_corner = count;
    const std::span<const Piece> pieces = look.world.pieces(look.world[i]);
    for (const Piece& piece : pieces.first(std::min(pieces.size(), kCornerPieces)))
        for (const glm::vec2& uv :
             {glm::vec2(kFromEdges), glm::vec2(1.0f - 2.0f * kFromEdges, kFromEdges),
              glm::vec2(kFromEdges, 1.0f - 2.0f * kFromEdges),
              glm::vec2(piece.parallelogram ? 1.0f - kFromEdges : 0.5f - kFromEdges)})
            points[count++] = point_in(piece, uv.x, uv.y);
    const std::span tested = std::span(hidden).first(is_clear ? first_corner : count);
    HiddenPoints are_hidden(look, inner, i, kAllDirections, false);
    are_hidden.look_for_backs(std::span(points).subspan(first_corner, kCornersOfPiece));
    are_hidden(std::span(points).first(tested.size()), tested);
    const auto hides = std::size_t(std::ranges::count(tested, true));
    return {hides == 0               ? Openness::open
            : hides == tested.size() ? Openness::hidden
                                     : Openness::partly,
            are_hidden.successful(), are_hidden.is_near_back()};
}

/// A batch of points of a lumel to test, with the addresses of their results.
class PointTests {
public:
    void add(const LumelPoint& point, bool& is_open)
    {
        points_.push_back(point);
        open_.push_back(&is_open);
    }

    void run(HiddenPoints& are_hidden)
    {
        const auto hidden = std::make_unique<bool[]>(points_.size());
        are_hidden(points_, {hidden.get(), points_.size()});
        for (std::size_t n = 0; n < points_.size(); ++n)
            *open_[n] = !hidden[n];
        points_.clear();
        open_.clear();
    }

private:
    std::vector<LumelPoint> points_;
    std::vector<bool*> open_;  ///< [points]
};

/// Reduces a piece to its open part, in strips along u or v, step by step: each adds points to
/// tests, which run before the next. Must not move meanwhile.
class Strips {
public:
    Strips(const LumelsInScene& look, std::size_t i, std::uint32_t index, int count)
        : piece_(look.lumels.pieces[look.lumels.lumels[i].first_piece + index]),
          in_world_(look.world.pieces(look.world[i])[index]),
          count_(count)
    {
    }

    void test_grid(PointTests& tests)
    {
        for (int line = 0; line < count_; ++line) {
            const float across = (float(line) + 0.5f) / float(count_);
            for (int k = 0; k < count_; ++k)
                tests.add(point(length_at(across) * (float(k) + 0.5f) / float(count_), across),
                          open_[at(line, k)]);
        }
    }

    /// Turns strips to the direction of more changes. In a parallelogram both grids have the same
    /// points, in a triangle nearly so.
    void turn(PointTests& tests)
    {
        Grid turned{};
        for (int line = 0; line < count_; ++line)
            for (int k = 0; k < count_; ++k)
                turned[at(line, k)] = open_[at(k, line)];
        swapped_ = changes(turned) > changes(open_);
        if (!swapped_)
            return;
        if (piece_.parallelogram)
            open_ = turned;
        else
            test_grid(tests);
    }

    void test_ends(PointTests& tests)
    {
        for (int strip = 0; strip < count_; ++strip)
            for (int k : {-1, count_})
                tests.add(point(place(strip, k), middle(strip)), ends_[strip][k < 0 ? 0 : 1]);
    }

    void find_edges()
    {
        for (int strip = 0; strip < count_; ++strip)
            for (int k = 0; k <= count_; ++k)
                if (is_open(strip, k) != is_open(strip, k - 1)) {
                    const float before = place(strip, k - 1), after = place(strip, k);
                    edges_.push_back(is_open(strip, k) ? Edge{strip, after, before}
                                                       : Edge{strip, before, after});
                }
    }

    void test_edges(PointTests& tests)
    {
        for (Edge& edge : edges_)
            tests.add(point(edge.middle(), middle(edge.strip)), edge.middle_is_open);
    }

    /// Bisects the interval of each edge.
    void narrow_edges()
    {
        for (Edge& edge : edges_)
            (edge.middle_is_open ? edge.open : edge.hidden) = edge.middle();
    }

    /// Appends the open part of each strip, in the lumel's frame.
    void append_open_parts(std::vector<Piece>& parts) const
    {
        const float step = 1.0f / float(count_);
        auto edge = edges_.begin();
        for (int strip = 0; strip < count_; ++strip) {
            const float low = step * float(strip);
            bool open = is_open(strip, -1);
            float begin = 0.0f;
            for (; edge != edges_.end() && edge->strip == strip; ++edge) {
                if (open)
                    append_run(low, step, begin, edge->middle(), parts);
                open = !open;
                begin = edge->middle();
            }
            if (open)
                append_run(low, step, begin, length_at(middle(strip)), parts);
        }
    }

private:
    /// [lines][points per line] true if open.
    using Grid = std::array<bool, std::size_t(kStrips) * kStrips>;
    static std::size_t at(int line, int k) { return std::size_t(line) * kStrips + std::size_t(k); }

    /// Between an open and a hidden point of a strip.
    struct Edge {
        int strip;
        float open, hidden;  ///< along the strip
        bool middle_is_open = false;

        float middle() const { return 0.5f * (open + hidden); }
    };

    LumelPoint point(float along, float across) const
    {
        return swapped_ ? point_in(in_world_, across, along) : point_in(in_world_, along, across);
    }

    /// Position of a strip's centre line.
    float middle(int strip) const { return (float(strip) + 0.5f) / float(count_); }

    /// Length of the piece along its strips, at a position across them.
    float length_at(float across) const { return piece_.parallelogram ? 1.0f : 1.0f - across; }

    /// Place of a tested point along its strip; -1 and count_: near the ends.
    float place(int strip, int k) const
    {
        const float length = length_at(middle(strip)), step = length / float(count_);
        return k < 0         ? kFromEdges * step
               : k == count_ ? length - kFromEdges * step
                             : (float(k) + 0.5f) * step;
    }

    bool is_open(int strip, int k) const
    {
        return k < 0 ? ends_[strip][0] : k == count_ ? ends_[strip][1] : open_[at(strip, k)];
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

    const Piece& piece_;
    const Piece& in_world_;
    int count_;             ///< ≤ kStrips
    bool swapped_ = false;  ///< strips are along v
    Grid open_{};
    std::array<std::array<bool, 2>, kStrips> ends_{};  ///< [strips] open
    std::vector<Edge> edges_;                          ///< along each strip, one after another
};

float local_area(const Piece& piece)
{
    return glm::length(glm::cross(piece.edge_u, piece.edge_v)) *
           (piece.parallelogram ? 1.0f : 0.5f);
}

/// The open pieces of a partly buried lumel, with their shares, and their share of the area.
struct OpenPart {
    std::size_t lumel = 0;
    std::vector<Piece> pieces;
    float share = 0.0f;

    template <class Archive>
    void state(Archive& archive)
    {
        archive(lumel, pieces, share);
    }
};

/// first: of its points; directions that opened none of them rarely open others.
OpenPart find_open_part(const LumelsInScene& look, const InnerSides& inner, std::size_t i,
                        const FirstLook& first)
{
    const Lumel& lumel = look.lumels.lumels[i];
    OpenPart part{i, {}, 0.0f};
    const int side = std::max(2, int(float(kStrips) / std::sqrt(float(lumel.piece_count))));
    std::vector<Strips> strips;
    strips.reserve(lumel.piece_count);
    float whole = 0.0f, open = 0.0f;
    for (std::uint32_t k = 0; k < lumel.piece_count; ++k) {
        whole += local_area(look.lumels.pieces[lumel.first_piece + k]);
        strips.emplace_back(look, i, k, side);
    }
    HiddenPoints are_hidden(look, inner, i, first.successful, first.is_near_back);
    PointTests tests;
    const auto test = [&](void (Strips::*add)(PointTests&)) {
        for (Strips& one : strips)
            (one.*add)(tests);
        tests.run(are_hidden);
    };
    test(&Strips::test_grid);
    test(&Strips::turn);
    test(&Strips::test_ends);
    for (Strips& one : strips)
        one.find_edges();
    for (int step = 0; step < kStripBisections; ++step) {
        test(&Strips::test_edges);
        for (Strips& one : strips)
            one.narrow_edges();
    }
    for (const Strips& one : strips)
        one.append_open_parts(part.pieces);
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

std::vector<float> mark_buried(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                               Lumels& lumels, const std::vector<char>& chosen,
                               const ProgressCallback& progress, Ranks* ranks)
{
    const std::size_t count = lumels.lumels.size(), blocks = (count + kBlock - 1) / kBlock;
    std::vector<std::vector<OpenPart>> reduced(blocks);
    {
        const WorldLumels world(scene, rays, lumels);
        const LumelsInScene look{scene, rays, world, lumels};
        const InnerSides inner(scene, atlas);
        const auto look_at = [&](std::size_t b) {
            for (std::size_t i = b * kBlock; i < std::min((b + 1) * kBlock, count); ++i) {
                if (!chosen.empty() && !chosen[i])
                    continue;
                OpenPart part{i, {}, 0.0f};
                if (inner.has(lumels.lumels[i])) {
                    reduced[b].push_back(part);
                    continue;
                }
                const FirstLook first = first_look(look, inner, i);
                if (first.openness == Openness::partly)
                    part = find_open_part(look, inner, i, first);
                if (first.openness != Openness::open && part.share < 1.0f)
                    reduced[b].push_back(std::move(part));
            }
        };
        for (std::size_t begin = 0, end; begin < blocks; begin = end) {
            end = std::min(begin + count_of(ranks) * kBlocksPerStep, blocks);
            parallel_for_own(ranks, begin, end, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t b = first; b < last; ++b)
                    look_at(b);
            });
            notify(progress, double(end) / double(blocks));
        }
    }
    share_blocks(ranks, 0, blocks, [&](auto& archive, std::size_t b) { archive(reduced[b]); });
    std::vector<float> shares(count, 1.0f);
    for (const std::vector<OpenPart>& parts : reduced)
        for (const OpenPart& part : parts)
            shares[part.lumel] = apply(lumels, part);
    return shares;
}

}  // namespace lumel
