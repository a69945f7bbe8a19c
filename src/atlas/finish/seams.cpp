// Least-squares seams, after the idea in M. Iwanicki, "Lighting Technology of The Last of Us",
// SIGGRAPH 2013 talks.
//
// Along a seam a point p of the world has two atlas positions. Bilinear sampling gives Σ a_k x_k on
// one side and Σ b_k x_k on the other, with four texels each. The texels x of such samples are
// changed as little as possible so that both sides agree:
//
//     minimise  Σ_p w_p (Σ a_pk x_k − Σ b_pk x_k)²  +  Σ_t λ_t (x_t − x⁰_t)²
//
// x⁰: the dilated map. w_p: kPull times the seam length [texels] per sample p. λ_t: kHoldGutter +
// kHold × coverage, so that gutters change freely and solved texels little. With x = x⁰ + d and
// rows g_p = a_p − b_p this is the linear system
//
//     (Gᵀ W G + Λ) d = −Gᵀ W G x⁰
//
// symmetric, positive definite and sparse: conjugate gradients with diagonal preconditioner,
// serial, so that equal maps give equal bytes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "atlas/finish/finish.h"
#include "atlas/finish/seam_edges.h"

namespace lumel {
namespace {

constexpr double kPull = 20.0;
constexpr double kHold = 1.0;
constexpr double kHoldGutter = 0.02;
constexpr float kSamplesPerTexel = 2.0f;  // bilinear weights have a kink at every texel
constexpr float kMaxSamples = 1.0e5f;     // per edge
constexpr float kLargestJump = 0.5f;      // relative
constexpr int kMaxIterations = 200;
constexpr double kTolerance = 1e-4;  // relative residual: no visible change beyond
constexpr std::uint32_t kUntouched = ~0u;

using Colors = std::vector<glm::dvec3>;  // per unknown

struct Footprint {
    std::array<std::uint32_t, 4> texels;
    std::array<float, 4> weights;
};

// A sample point of a seam: four texels of one side minus four of the other.
struct Row {
    std::array<std::uint32_t, 8> unknowns;
    std::array<float, 8> weights;
    double pull;
};

struct System {
    std::vector<Row> rows;
    std::vector<std::uint32_t> texels;  // per unknown
    std::vector<double> hold;           // λ per unknown
    std::vector<double> diagonal;       // diagonal of Gᵀ W G + Λ
};

Footprint bilinear(const Image& map, const glm::vec2& place)
{
    const float x = std::clamp(place.x - 0.5f, 0.0f, float(map.width - 1));
    const float y = std::clamp(place.y - 0.5f, 0.0f, float(map.height - 1));
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, map.width - 1), y1 = std::min(y0 + 1, map.height - 1);
    const float u = x - float(x0), v = y - float(y0);
    const auto texel = [&](int column, int row) { return std::uint32_t(row * map.width + column); };
    return {{texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1)},
            {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}};
}

float brightness(const Image& map, const Footprint& footprint)
{
    float sum = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) {
        const float* rgb = map.values.data() + std::size_t(footprint.texels[k]) * 4;
        sum += footprint.weights[k] * (rgb[0] + rgb[1] + rgb[2]);
    }
    return sum;
}

// Calls visit(a, b, length) for points along a seam: both positions, and the texels of length per
// point.
template <class Visit>
void along(const Image& map, const Seam& seam, const Visit& visit)
{
    const float length =
        std::max(glm::distance(seam.a[0], seam.a[1]), glm::distance(seam.b[0], seam.b[1]));
    if (!(length > 0.0f))
        return;
    const int count = int(std::clamp(std::ceil(kSamplesPerTexel * length), 1.0f, kMaxSamples)) + 1;
    for (int i = 0; i < count; ++i) {
        const float t = float(i) / float(count - 1);
        visit(bilinear(map, glm::mix(seam.a[0], seam.a[1], t)),
              bilinear(map, glm::mix(seam.b[0], seam.b[1], t)), double(length) / double(count));
    }
}

// True for a discontinuity of the light itself.
bool jumps(float light_a, float light_b)
{
    return std::abs(light_a - light_b) > kLargestJump * std::max(light_a, light_b);
}

// Rows have texel indices here; number_unknowns replaces them.
void add_rows(const Image& map, const Seam& seam, std::vector<Row>& rows)
{
    along(map, seam, [&](const Footprint& a, const Footprint& b, double length) {
        if (jumps(brightness(map, a), brightness(map, b)))
            return;
        Row row;
        for (std::size_t k = 0; k < 4; ++k) {
            row.unknowns[k] = a.texels[k];
            row.weights[k] = a.weights[k];
            row.unknowns[k + 4] = b.texels[k];
            row.weights[k + 4] = -b.weights[k];
        }
        row.pull = kPull * length;
        rows.push_back(row);
    });
}

void number_unknowns(const Lumels& lumels, System& system)
{
    std::vector<std::uint32_t> number(lumels.coverage.size(), kUntouched);
    for (Row& row : system.rows)
        for (std::uint32_t& unknown : row.unknowns) {
            const std::uint32_t texel = unknown;
            if (number[texel] == kUntouched) {
                number[texel] = std::uint32_t(system.texels.size());
                system.texels.push_back(texel);
                system.hold.push_back(kHoldGutter + kHold * double(lumels.coverage[texel]));
            }
            unknown = number[texel];
        }
    system.diagonal = system.hold;
    for (const Row& row : system.rows)
        for (std::size_t k = 0; k < 8; ++k)
            system.diagonal[row.unknowns[k]] += row.pull * row.weights[k] * row.weights[k];
}

// result += Gᵀ W G x
void add_seam_term(const System& system, const Colors& x, Colors& result)
{
    for (const Row& row : system.rows) {
        glm::dvec3 gap(0.0);
        for (std::size_t k = 0; k < 8; ++k)
            gap += double(row.weights[k]) * x[row.unknowns[k]];
        gap *= row.pull;
        for (std::size_t k = 0; k < 8; ++k)
            result[row.unknowns[k]] += double(row.weights[k]) * gap;
    }
}

glm::dvec3 dot(const Colors& a, const Colors& b)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

// 0 for channels that have converged or are black.
glm::dvec3 ratio(const glm::dvec3& a, const glm::dvec3& b)
{
    glm::dvec3 result(0.0);
    for (int c = 0; c < 3; ++c)
        if (b[c] > 0.0)
            result[c] = a[c] / b[c];
    return result;
}

// Solves (Gᵀ W G + Λ) d = −Gᵀ W G x⁰ by preconditioned conjugate gradients, for all three channels
// at once.
Colors solve(const System& system, const Colors& x0)
{
    const std::size_t count = x0.size();
    Colors d(count), residual(count), scaled(count), direction(count), image(count);
    add_seam_term(system, x0, residual);
    for (std::size_t i = 0; i < count; ++i) {
        residual[i] = -residual[i];
        direction[i] = scaled[i] = residual[i] / system.diagonal[i];
    }
    glm::dvec3 length = dot(residual, scaled);
    const glm::dvec3 enough = length * (kTolerance * kTolerance);
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        if (glm::all(glm::lessThanEqual(length, enough)))
            break;
        for (std::size_t i = 0; i < count; ++i)
            image[i] = system.hold[i] * direction[i];
        add_seam_term(system, direction, image);
        const glm::dvec3 step = ratio(length, dot(direction, image));
        for (std::size_t i = 0; i < count; ++i) {
            d[i] += step * direction[i];
            residual[i] -= step * image[i];
            scaled[i] = residual[i] / system.diagonal[i];
        }
        const glm::dvec3 next = dot(residual, scaled);
        const glm::dvec3 turn = ratio(next, length);
        for (std::size_t i = 0; i < count; ++i)
            direction[i] = scaled[i] + turn * direction[i];
        length = next;
    }
    return d;
}

// Updates the unknowns of a map, clamped at `least`.
void apply(const System& system, Image& map, double least)
{
    Colors x0;
    for (const std::uint32_t texel : system.texels) {
        const float* rgb = map.values.data() + std::size_t(texel) * 4;
        x0.emplace_back(rgb[0], rgb[1], rgb[2]);
    }
    const Colors d = solve(system, x0);
    for (std::size_t i = 0; i < d.size(); ++i)
        for (int c = 0; c < 3; ++c)
            map.values[std::size_t(system.texels[i]) * 4 + std::size_t(c)] =
                float(std::max(x0[i][c] + d[i][c], least));
}

}  // namespace

SeamGaps seam_gaps(const Image& map, const Image& judge, const Scene& scene, const Atlas& atlas)
{
    SeamGaps gaps;
    double squares = 0.0;
    for (const Seam& seam : find_seams(scene, atlas))
        along(map, seam, [&](const Footprint& a, const Footprint& b, double length) {
            gaps.length += length;
            if (jumps(brightness(judge, a), brightness(judge, b))) {
                gaps.jumping += length;
                return;
            }
            const double light_a = double(brightness(map, a)), light_b = double(brightness(map, b));
            const double most = std::max(light_a, light_b);
            const double gap = most > 0.0 ? (light_a - light_b) / most : 0.0;
            squares += gap * gap * length;
        });
    if (gaps.length > gaps.jumping)
        gaps.gap = std::sqrt(squares / (gaps.length - gaps.jumping));
    if (gaps.length > 0.0)
        gaps.jumping /= gaps.length;
    return gaps;
}

void match_seams(Image& map, const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<Image> layers)
{
    System system;
    for (const Seam& seam : find_seams(scene, atlas))
        add_rows(map, seam, system.rows);
    number_unknowns(lumels, system);
    apply(system, map, 0.0);
    for (Image& layer : layers)
        apply(system, layer, std::numeric_limits<double>::lowest());
}

std::uint64_t finish_bytes(const Atlas& atlas)
{
    // Two samples per texel of a seam, whose two sides are borders; both may use as many texels as
    // they are long, on either side of the border.
    constexpr double kRows = kSamplesPerTexel / 2.0, kUnknowns = 2.0;
    constexpr std::size_t kColors = 6;  // vectors of the conjugate gradients
    constexpr double kOfUnknown =
        kColors * sizeof(glm::dvec3) + 2 * sizeof(double) + sizeof(std::uint32_t);
    const SeamSizes sizes = seam_sizes(atlas);
    const std::uint64_t of_texels =
        std::uint64_t(atlas.width) * std::uint64_t(atlas.height) * sizeof(std::uint32_t);
    const double solving = sizes.length * (kRows * double(sizeof(Row)) + kUnknowns * kOfUnknown);
    return of_texels + std::max(seam_edge_bytes(sizes.edges), std::uint64_t(solving));
}

}  // namespace lumel
