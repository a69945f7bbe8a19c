// A uniform hierarchical matrix of one level [Hac15], coded like a picture:
//
// 1. Patches are put into clusters of 64 that lie together and face the same way.
// 2. Each cluster gets the basis in which its rows have most of their energy in few coefficients
//    (principal components), so that all of the matrix becomes T = Q K Q^T, K the balanced matrix.
// 3. The three channels, which differ only in later bounces, become three axes, two of them small.
// 4. Tiles of 4 × 4 coefficients are dropped or stored with 4 or 8 bits: whatever is least of
//    distortion + λ bytes. λ is found for the error that is asked for.
//
// Distortion counts by the light that a coefficient is likely to meet: direct light falls on
// patches much as light from other patches does, so coefficient j is expected to have the energy of
// row j of T.

#include "matrix/compressed_tiles.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.h"
#include "core/parallel.h"
#include "matrix/balanced.h"
#include "matrix/blas.h"
#include "matrix/clusters.h"
#include "matrix/half.h"

namespace lumel {
namespace {

constexpr std::array<glm::vec3, 3> kAxes = {kGrayAxis, kRedBlueAxis, kGreenAxis};
constexpr std::size_t kTexels = std::size_t(kTile) * kTile;
constexpr std::size_t kBasis = std::size_t(kCluster) * kCluster;
constexpr std::size_t kTileRowsPerTask = 16;
constexpr int kSearchSteps = 40;  // halvings of λ's logarithm
constexpr double kPlaceBytes = 4.0;
constexpr double kFineBytes = kPlaceBytes + 16.0, kCoarseBytes = kPlaceBytes + 8.0;

using Tile = std::array<float, kTexels>;

enum class Kind : std::uint8_t { dropped, coarse, fine };

/// Matrices of one side, filled up to whole clusters.
struct Coefficients {
    std::size_t side = 0;
    std::array<std::vector<float>, 3> axis;  ///< [side][side]

    Tile tile(int a, std::size_t row, std::size_t column) const
    {
        Tile tile;
        for (std::size_t i = 0; i < kTexels; ++i)
            tile[i] = axis[a][(row * kTile + i / kTile) * side + column * kTile + i % kTile];
        return tile;
    }
    std::size_t tile_rows() const { return side / kTile; }
};

std::size_t filled(std::size_t n)
{
    return (n + kCluster - 1) / kCluster * kCluster;
}

/// K in clusters' order, by axes.
Coefficients by_axes(const ColorMatrix& balanced, std::span<const std::uint32_t> order)
{
    const std::size_t n = order.size();
    Coefficients result{filled(n), {}};
    for (int a = 0; a < 3; ++a) {
        result.axis[a].assign(result.side * result.side, 0.0f);
        parallel_for(n, kTileRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    for (int c = 0; c < 3; ++c)
                        result.axis[a][i * result.side + j] +=
                            kAxes[a][c] * balanced.channel[c].at(order[i], order[j]);
        });
    }
    return result;
}

/// For each cluster [coefficient][place], the coefficient of most energy first; as halves keep it.
std::vector<float> find_bases(const Coefficients& matrix)
{
    std::vector<float> bases(matrix.side / kCluster * kBasis);
    for (std::size_t b = 0; b < matrix.side / kCluster; ++b) {
        const std::span<const float> rows(&matrix.axis[0][b * kCluster * matrix.side],
                                          kCluster * matrix.side);
        const auto basis = std::span(bases).subspan(b * kBasis, kBasis);
        const auto width = std::uint32_t(matrix.side);
        blas::product({rows, kCluster, width}, blas::transposed(rows, kCluster, width), basis);
        blas::eigenvectors(basis, kCluster);
        for (float& value : basis)
            value = from_half(to_half(value));
    }
    return bases;
}

/// row [side] ← Q row, cluster by cluster; or ← Q^T row.
void transform(std::span<const float> bases, std::span<float> row, bool back)
{
    std::array<float, kCluster> sum;
    for (std::size_t b = 0; b < row.size() / kCluster; ++b) {
        const auto part = row.subspan(b * kCluster, kCluster);
        const auto basis = bases.subspan(b * kBasis, kBasis);
        sum.fill(0.0f);
        for (std::size_t i = 0; i < kCluster; ++i)
            for (std::size_t j = 0; j < kCluster; ++j)
                if (back)
                    sum[j] += part[i] * basis[i * kCluster + j];
                else
                    sum[i] += part[j] * basis[i * kCluster + j];
        std::copy(sum.begin(), sum.end(), part.begin());
    }
}

void transpose(std::vector<float>& values, std::size_t side)
{
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < i; ++j)
            std::swap(values[i * side + j], values[j * side + i]);
}

/// Q K Q^T, or Q^T T Q, in place.
void transform(std::span<const float> bases, Coefficients& matrix, bool back)
{
    for (std::vector<float>& values : matrix.axis)
        for (int side = 0; side < 2; ++side) {
            parallel_for(matrix.side, kTileRowsPerTask, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    transform(bases, std::span(values).subspan(i * matrix.side, matrix.side), back);
            });
            transpose(values, matrix.side);
        }
}

/// Energy that a coefficient is expected to have.
std::vector<float> expected_energy(const Coefficients& matrix)
{
    std::vector<float> energy(matrix.side);
    for (std::size_t i = 0; i < matrix.side; ++i)
        for (std::size_t j = 0; j < matrix.side; ++j) {
            const float value = matrix.axis[0][i * matrix.side + j];
            energy[i] += value * value;
        }
    return energy;
}

float largest_of(const Tile& tile)
{
    float largest = 0.0f;
    for (const float value : tile)
        largest = std::max(largest, std::abs(value));
    return largest;
}

/// A tile's codes and what the largest means.
struct CodedTile {
    std::uint16_t scale = 0;  ///< half float, in units
    std::array<int, kTexels> code{};
};

CodedTile code_tile(const Tile& tile, float unit, float codes)
{
    CodedTile coded{.scale = to_half(largest_of(tile) / unit)};
    const float scale = from_half(coded.scale) * unit;
    if (scale > 0.0f)
        for (std::size_t i = 0; i < kTexels; ++i)
            coded.code[i] = int(std::lround(std::clamp(tile[i] / scale, -1.0f, 1.0f) * codes));
    return coded;
}

/// What becomes of a tile.
Tile decoded(const CodedTile& coded, float unit, float codes)
{
    Tile tile;
    const float step = from_half(coded.scale) * unit / codes;
    for (std::size_t i = 0; i < kTexels; ++i)
        tile[i] = float(coded.code[i]) * step;
    return tile;
}

/// Distortion of one tile by kind.
struct Loss {
    float dropped = 0.0f, coarse = 0.0f, fine = 0.0f;
};

double cost(const Loss& loss, double lambda, Kind& kind)
{
    const double dropped = double(loss.dropped);
    const double coarse = double(loss.coarse) + lambda * kCoarseBytes;
    const double fine = double(loss.fine) + lambda * kFineBytes;
    kind = dropped <= std::min(coarse, fine) ? Kind::dropped
                                             : (coarse <= fine ? Kind::coarse : Kind::fine);
    return kind == Kind::dropped ? double(loss.dropped)
                                 : double(kind == Kind::coarse ? loss.coarse : loss.fine);
}

/// [axis][tile row][tile column]
std::vector<Loss> losses(const Coefficients& matrix, float unit)
{
    const std::vector<float> energy = expected_energy(matrix);
    const std::size_t rows = matrix.tile_rows();
    std::vector<Loss> result(3 * rows * rows);
    parallel_for(3 * rows, kTileRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < rows; ++column) {
                const Tile tile = matrix.tile(int(row / rows), row % rows, column);
                const Tile fine = decoded(code_tile(tile, unit, kFineCodes), unit, kFineCodes);
                const Tile coarse =
                    decoded(code_tile(tile, unit, kCoarseCodes), unit, kCoarseCodes);
                Loss& loss = result[row * rows + column];
                for (std::size_t i = 0; i < kTexels; ++i) {
                    const float weight = energy[column * kTile + i % kTile];
                    loss.dropped += weight * tile[i] * tile[i];
                    loss.coarse += weight * (tile[i] - coarse[i]) * (tile[i] - coarse[i]);
                    loss.fine += weight * (tile[i] - fine[i]) * (tile[i] - fine[i]);
                }
            }
    });
    return result;
}

/// The largest λ whose distortion stays within `error` of all energy.
double find_lambda(std::span<const Loss> losses, float error)
{
    double all = 0.0, largest = 0.0;
    for (const Loss& loss : losses) {
        all += double(loss.dropped);
        largest = std::max(largest, double(loss.dropped));
    }
    const double allowed = all * double(error) * double(error);
    double low = -60.0, high = 0.0;  // log2 of λ in the largest tile's energy
    for (int step = 0; step < kSearchSteps; ++step) {
        const double middle = 0.5 * (low + high), lambda = largest * std::exp2(middle);
        double distortion = 0.0;
        Kind kind;
        for (const Loss& loss : losses)
            distortion += cost(loss, lambda, kind);
        (distortion <= allowed ? low : high) = middle;
    }
    return largest * std::exp2(low);
}

void append(TileRows& rows, const CodedTile& tile, std::size_t column, int bits)
{
    rows.place.push_back(std::uint32_t(tile.scale) << 16 | std::uint32_t(column));
    const int per_word = 32 / bits;
    for (std::size_t i = 0; i < kTexels; i += std::size_t(per_word)) {
        std::uint32_t word = 0;
        for (int k = 0; k < per_word; ++k)
            word |= (std::uint32_t(tile.code[i + std::size_t(k)]) & ((1u << bits) - 1u))
                    << (k * bits);
        rows.codes.push_back(word);
    }
}

void store(TiledMatrix& tiled, const Coefficients& matrix, std::span<const Loss> losses,
           double lambda)
{
    const std::size_t rows = matrix.tile_rows();
    std::vector<std::uint32_t> used(rows / (kCluster / kTile));
    const auto use = [&](std::size_t tile_row) {
        std::uint32_t& most = used[tile_row * kTile / kCluster];
        most = std::max(most, std::uint32_t((tile_row * kTile) % kCluster + kTile));
    };
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t row = 0; row < rows; ++row) {
            tiled.fine[axis].first.push_back(std::uint32_t(tiled.fine[axis].place.size()));
            tiled.coarse[axis].first.push_back(std::uint32_t(tiled.coarse[axis].place.size()));
            for (std::size_t column = 0; column < rows; ++column) {
                Kind kind;
                cost(losses[(std::size_t(axis) * rows + row) * rows + column], lambda, kind);
                if (kind == Kind::dropped)
                    continue;
                use(row);
                use(column);
                const bool fine = kind == Kind::fine;
                append((fine ? tiled.fine : tiled.coarse)[axis],
                       code_tile(matrix.tile(axis, row, column), tiled.unit,
                                 fine ? kFineCodes : kCoarseCodes),
                       column, fine ? 8 : 4);
            }
        }
    for (int axis = 0; axis < 3; ++axis) {
        tiled.fine[axis].first.push_back(std::uint32_t(tiled.fine[axis].place.size()));
        tiled.coarse[axis].first.push_back(std::uint32_t(tiled.coarse[axis].place.size()));
    }
    tiled.kept = used;
}

void store_bases(TiledMatrix& tiled, std::span<const float> bases)
{
    for (std::size_t b = 0; b < tiled.kept.size(); ++b)
        for (std::size_t i = 0; i < std::size_t(tiled.kept[b]) * kCluster; ++i)
            tiled.basis.push_back(to_half(bases[b * kBasis + i]));
}

/// Adds the tiles to one axis of T.
void load(const TileRows& tiles, float unit, int bits, float codes, std::size_t side,
          std::vector<float>& values)
{
    const int per_word = 32 / bits;
    for (std::size_t row = 0; row + 1 < tiles.first.size(); ++row)
        for (std::size_t tile = tiles.first[row]; tile < tiles.first[row + 1]; ++tile) {
            const std::size_t column = tiles.place[tile] & 0xffffu;
            const float step = from_half(std::uint16_t(tiles.place[tile] >> 16)) * unit / codes;
            for (std::size_t i = 0; i < kTexels; ++i) {
                const std::size_t at = tile * kTexels + i;
                const std::uint32_t word = tiles.codes[at / std::size_t(per_word)];
                const int shift = 32 - bits * (int(at % std::size_t(per_word)) + 1);
                const int code = int(word << shift) >> (32 - bits);  // with its sign
                values[(row * kTile + i / kTile) * side + column * kTile + i % kTile] +=
                    float(code) * step;
            }
        }
}

std::vector<float> load_bases(const TiledMatrix& tiled)
{
    std::vector<float> bases(tiled.kept.size() * kBasis);
    std::size_t from = 0;
    for (std::size_t b = 0; b < tiled.kept.size(); ++b)
        for (std::size_t i = 0; i < std::size_t(tiled.kept[b]) * kCluster; ++i)
            bases[b * kBasis + i] = from_half(tiled.basis[from++]);
    return bases;
}

}  // namespace

std::size_t TiledMatrix::bytes() const
{
    std::size_t count = order.size() * sizeof(std::uint32_t) + kept.size() * sizeof(std::uint32_t) +
                        basis.size() * sizeof(std::uint16_t) + color.size() * sizeof(glm::vec3) +
                        root_area.size() * sizeof(float);
    for (const auto* kinds : {&fine, &coarse})
        for (const TileRows& rows : *kinds)
            count +=
                (rows.first.size() + rows.place.size() + rows.codes.size()) * sizeof(std::uint32_t);
    return count;
}

TiledMatrix compress_tiles(const ColorMatrix& matrix, const Elements& elements,
                           const TileOptions& options)
{
    if (filled(matrix.size()) / kTile > 0x10000u)
        throw Error(ErrorKind::input, "form-factor matrix", "is too large; use fewer patches");
    TiledMatrix tiled{.size = matrix.size()};
    const ColorMatrix balance = balanced(matrix, elements);
    tiled.order = cluster_order(elements, kCluster);
    tiled.color = elements.color;
    tiled.root_area = root_areas(elements);
    Coefficients coefficients = by_axes(balance, tiled.order);
    const std::vector<float> bases = find_bases(coefficients);
    transform(bases, coefficients, false);
    for (const std::vector<float>& axis : coefficients.axis)
        tiled.unit = std::max(&axis == &coefficients.axis[0] ? 0.0f : tiled.unit, half_unit(axis));
    const std::vector<Loss> loss = losses(coefficients, tiled.unit);
    store(tiled, coefficients, loss, find_lambda(loss, options.error));
    store_bases(tiled, bases);
    return tiled;
}

ColorMatrix decompress(const TiledMatrix& tiled)
{
    const std::size_t n = tiled.size;
    Coefficients coefficients{filled(n), {}};
    for (int a = 0; a < 3; ++a) {
        coefficients.axis[a].assign(coefficients.side * coefficients.side, 0.0f);
        load(tiled.fine[a], tiled.unit, 8, kFineCodes, coefficients.side, coefficients.axis[a]);
        load(tiled.coarse[a], tiled.unit, 4, kCoarseCodes, coefficients.side, coefficients.axis[a]);
    }
    transform(load_bases(tiled), coefficients, true);
    ColorMatrix result;
    for (int c = 0; c < 3; ++c) {
        result.channel[c] = {tiled.size, std::vector<float>(n * n)};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                for (int a = 0; a < 3; ++a)
                    result.channel[c].values[std::size_t(tiled.order[i]) * n + tiled.order[j]] +=
                        kAxes[a][c] * coefficients.axis[a][i * coefficients.side + j];
    }
    return unbalanced(result, tiled.color, tiled.root_area);
}

}  // namespace lumel
