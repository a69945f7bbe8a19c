// A uniform hierarchical matrix of one level [Hac15], coded like a picture:
//
// 1. Patches are put into clusters of 64 that lie together and face the same way.
// 2. Each cluster gets the basis in which its rows have most of their energy in few coefficients
//    (principal components), rounded to 8 bits. All of the matrix becomes T, K = Q^T T Q, K the
//    balanced matrix; the dual of Q makes up for its rounding.
// 3. The three channels, which differ only in later bounces, become three axes, two of them small.
// 4. Tiles of 4 × 4 coefficients are dropped or stored with 4, 8 or 16 bits: whatever is least of
//    distortion + λ bytes. λ is found for the error that is asked for.
//
// Distortion counts by the light that a coefficient is likely to meet: direct light falls on
// patches much as light from other patches does, but has more detail than light of all bounces. The
// root of the energy of T's rows was best among its powers, by bytes for the same error of real
// direct light.

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

/// The estimate of an error by `expected_light` is so much of what real direct light shows, by
/// `lumel-papers matrix`.
constexpr double kEstimateOfError = 0.55;
constexpr std::array<float, kPrecisions> kCodes = {kCodes4, kCodes8, kCodes16};
constexpr int kDropped = kPrecisions;  // the precision of tiles that are not stored

using Tile = std::array<float, kTexels>;

double tile_bytes(int precision)
{
    constexpr double place_bytes = 4.0;
    return precision == kDropped
               ? 0.0
               : place_bytes + double(kTexels * kTileBits[std::size_t(precision)]) / 8.0;
}

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

/// Rows of a basis in 8 bits.
struct CodedBasis {
    std::vector<std::int8_t> codes;  ///< [rows][kCluster]
    std::vector<float> units;        ///< [rows]

    std::size_t rows() const { return units.size(); }
    float at(std::size_t row, std::size_t column) const
    {
        return float(codes[row * kCluster + column]) * units[row] / kCodes8;
    }
};

void append_rows(CodedBasis& basis, std::span<const float> values)
{
    for (std::size_t first = 0; first < values.size(); first += kCluster) {
        const auto row = values.subspan(first, kCluster);
        float unit = 0.0f;
        for (const float value : row)
            unit = std::max(unit, std::abs(value));
        basis.units.push_back(unit);
        for (const float value : row)
            basis.codes.push_back(unit > 0.0f ? std::int8_t(std::lround(value / unit * kCodes8))
                                              : std::int8_t(0));
    }
}

/// For each cluster [coefficient][place], the coefficient of most energy first.
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
    }
    return bases;
}

/// Q^-T for each cluster, Q as it is stored: T = Q^-T K Q^-1.
std::vector<float> duals(const CodedBasis& bases)
{
    std::vector<float> result(bases.codes.size());
    for (std::size_t b = 0; b < result.size() / kBasis; ++b) {
        std::vector<float> transposed(kBasis);
        const auto dual = std::span(result).subspan(b * kBasis, kBasis);
        for (std::size_t i = 0; i < kCluster; ++i) {
            dual[i * kCluster + i] = 1.0f;
            for (std::size_t j = 0; j < kCluster; ++j)
                transposed[j * kCluster + i] = bases.at(b * kCluster + i, j);
        }
        if (!blas::solve_from_right(transposed, dual, kCluster))
            throw Error(ErrorKind::input, "form-factor matrix",
                        "has patches of which nothing can be told apart; use fewer patches");
    }
    return result;
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

/// Makes K symmetric, which rounding left it nearly.
void symmetrise(Coefficients& matrix)
{
    for (std::vector<float>& values : matrix.axis)
        for (std::size_t i = 0; i < matrix.side; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                float& below = values[i * matrix.side + j];
                float& above = values[j * matrix.side + i];
                below = above = 0.5f * (below + above);
            }
}

/// Weight of the error at a coefficient of what T is multiplied by.
std::vector<float> expected_light(const Coefficients& matrix)
{
    std::vector<float> weight(matrix.side);
    for (std::size_t i = 0; i < matrix.side; ++i) {
        float energy = 0.0f;
        for (std::size_t j = 0; j < matrix.side; ++j) {
            const float value = matrix.axis[0][i * matrix.side + j];
            energy += value * value;
        }
        weight[i] = std::sqrt(energy);
    }
    return weight;
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

/// Distortion of one tile by precision, kDropped the last.
using Loss = std::array<float, kPrecisions + 1>;

/// What costs least.
int choose_precision(const Loss& loss, double lambda)
{
    int best = kDropped;
    for (int precision = kDropped - 1; precision >= 0; --precision)
        if (double(loss[std::size_t(precision)]) + lambda * tile_bytes(precision) <
            double(loss[std::size_t(best)]) + lambda * tile_bytes(best))
            best = precision;
    return best;
}

/// [axis][tile row][tile column ≤ row]; each tile stands for its mirror image too.
std::vector<Loss> losses(const Coefficients& matrix, float unit)
{
    const std::vector<float> light = expected_light(matrix);
    const std::size_t rows = matrix.tile_rows();
    std::vector<Loss> result(3 * rows * rows);
    parallel_for(3 * rows, kTileRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column <= row % rows; ++column) {
                const Tile tile = matrix.tile(int(row / rows), row % rows, column);
                for (std::size_t kind = 0; kind <= kPrecisions; ++kind) {
                    const Tile stored =
                        kind < kPrecisions
                            ? decoded(code_tile(tile, unit, kCodes[kind]), unit, kCodes[kind])
                            : Tile{};
                    for (std::size_t i = 0; i < kTexels; ++i) {
                        const float weight = light[column * kTile + i % kTile] +
                                             light[row % rows * kTile + i / kTile];
                        result[row * rows + column][kind] +=
                            weight * (tile[i] - stored[i]) * (tile[i] - stored[i]);
                    }
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
        all += double(loss[kDropped]);
        largest = std::max(largest, double(loss[kDropped]));
    }
    const double estimate = kEstimateOfError * double(error);
    const double allowed = all * estimate * estimate;
    double low = -60.0, high = 0.0;  // log2 of λ in the largest tile's energy
    for (int step = 0; step < kSearchSteps; ++step) {
        const double middle = 0.5 * (low + high), lambda = largest * std::exp2(middle);
        double distortion = 0.0;
        for (const Loss& loss : losses)
            distortion += double(loss[std::size_t(choose_precision(loss, lambda))]);
        (distortion <= allowed ? low : high) = middle;
    }
    return largest * std::exp2(low);
}

void append(TileRows& rows, const CodedTile& tile, std::size_t column, std::uint32_t bits)
{
    rows.place.push_back(std::uint32_t(tile.scale) << 16 | std::uint32_t(column));
    const std::size_t per_word = 32 / bits;
    for (std::size_t i = 0; i < kTexels; i += per_word) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < per_word; ++k)
            word |= (std::uint32_t(tile.code[i + k]) & ((1u << bits) - 1u)) << (k * bits);
        rows.codes.push_back(word);
    }
}

void begin_row(TiledMatrix& tiled, std::size_t axis)
{
    for (std::array<TileRows, 3>& axes : tiled.tiles)
        axes[axis].first.push_back(std::uint32_t(axes[axis].place.size()));
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
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = 0; row < rows; ++row) {
            begin_row(tiled, axis);
            for (std::size_t column = 0; column <= row; ++column) {
                const int kind =
                    choose_precision(losses[(axis * rows + row) * rows + column], lambda);
                if (kind == kDropped)
                    continue;
                use(row);
                use(column);
                const auto precision = std::size_t(kind);
                append(
                    tiled.tiles[precision][axis],
                    code_tile(matrix.tile(int(axis), row, column), tiled.unit, kCodes[precision]),
                    column, kTileBits[precision]);
            }
        }
        begin_row(tiled, axis);  // where the last one ends
    }
    tiled.kept = used;
}

/// Of each cluster the rows that are used.
void store_bases(TiledMatrix& tiled, const CodedBasis& bases)
{
    for (std::size_t b = 0; b < tiled.kept.size(); ++b)
        for (std::size_t row = b * kCluster; row < b * kCluster + tiled.kept[b]; ++row) {
            tiled.basis_unit.push_back(bases.units[row]);
            tiled.basis.insert(tiled.basis.end(),
                               bases.codes.begin() + std::ptrdiff_t(row * kCluster),
                               bases.codes.begin() + std::ptrdiff_t((row + 1) * kCluster));
        }
}

int code_at(const TileRows& tiles, std::size_t tile, std::size_t texel, std::uint32_t bits)
{
    const std::size_t per_word = 32 / bits, at = tile * kTexels + texel;
    const auto shift = 32 - bits * std::uint32_t(at % per_word + 1);
    return int(tiles.codes[at / per_word] << shift) >> (32 - bits);  // with its sign
}

/// Adds the tiles to one axis of T.
void load(const TileRows& tiles, float unit, std::size_t precision, std::size_t side,
          std::vector<float>& values)
{
    for (std::size_t row = 0; row + 1 < tiles.first.size(); ++row)
        for (std::size_t tile = tiles.first[row]; tile < tiles.first[row + 1]; ++tile) {
            const std::size_t column = tiles.place[tile] & 0xffffu;
            const float step =
                from_half(std::uint16_t(tiles.place[tile] >> 16)) * unit / kCodes[precision];
            for (std::size_t i = 0; i < kTexels; ++i) {
                const std::size_t r = row * kTile + i / kTile, c = column * kTile + i % kTile;
                const float value = float(code_at(tiles, tile, i, kTileBits[precision])) * step;
                values[r * side + c] = value;
                values[c * side + r] = value;
            }
        }
}

std::vector<float> load_bases(const TiledMatrix& tiled)
{
    const CodedBasis coded{tiled.basis, tiled.basis_unit};
    std::vector<float> bases(tiled.kept.size() * kBasis);
    std::size_t from = 0;
    for (std::size_t b = 0; b < tiled.kept.size(); ++b)
        for (std::size_t row = 0; row < tiled.kept[b]; ++row, ++from)
            for (std::size_t column = 0; column < kCluster; ++column)
                bases[b * kBasis + row * kCluster + column] = coded.at(from, column);
    return bases;
}

/// [axis] A tile's mirror image belongs into row `column`.
TileRows with_mirror_images(const TileRows& below, std::uint32_t bits)
{
    struct Source {
        std::uint32_t column, tile;
        bool mirrored;
    };
    std::vector<std::vector<Source>> rows(below.first.empty() ? 0 : below.first.size() - 1);
    for (std::uint32_t row = 0; row < rows.size(); ++row)
        for (std::uint32_t tile = below.first[row]; tile < below.first[row + 1]; ++tile) {
            const std::uint32_t column = below.place[tile] & 0xffffu;
            rows[row].push_back({column, tile, false});
            if (column != row)
                rows[column].push_back({row, tile, true});
        }
    TileRows all;
    for (const std::vector<Source>& row : rows) {
        all.first.push_back(std::uint32_t(all.place.size()));
        for (const Source& source : row) {
            CodedTile tile{.scale = std::uint16_t(below.place[source.tile] >> 16)};
            for (std::size_t i = 0; i < kTexels; ++i)
                tile.code[source.mirrored ? i % kTile * kTile + i / kTile : i] =
                    code_at(below, source.tile, i, bits);
            append(all, tile, source.column, bits);
        }
    }
    all.first.push_back(std::uint32_t(all.place.size()));
    return all;
}

}  // namespace

std::size_t TiledMatrix::bytes() const
{
    std::size_t count = order.size() * sizeof(std::uint32_t) + kept.size() * sizeof(std::uint32_t) +
                        basis.size() + basis_unit.size() * sizeof(float) +
                        color.size() * sizeof(glm::vec3) + root_area.size() * sizeof(float);
    for (const std::array<TileRows, 3>& axes : tiles)
        for (const TileRows& rows : axes)
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
    symmetrise(coefficients);
    CodedBasis bases;
    append_rows(bases, find_bases(coefficients));
    transform(duals(bases), coefficients, false);
    tiled.unit = half_unit(coefficients.axis[0]);
    for (const std::vector<float>& axis : coefficients.axis)
        tiled.unit = std::max(tiled.unit, half_unit(axis));
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
        for (std::size_t precision = 0; precision < kPrecisions; ++precision)
            load(tiled.tiles[precision][a], tiled.unit, precision, coefficients.side,
                 coefficients.axis[a]);
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

std::array<std::array<TileRows, 3>, kPrecisions> both_halves(const TiledMatrix& tiled)
{
    std::array<std::array<TileRows, 3>, kPrecisions> all;
    for (std::size_t precision = 0; precision < kPrecisions; ++precision)
        for (std::size_t axis = 0; axis < 3; ++axis)
            all[precision][axis] =
                with_mirror_images(tiled.tiles[precision][axis], kTileBits[precision]);
    return all;
}

}  // namespace lumel
