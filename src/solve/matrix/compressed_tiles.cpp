// A uniform hierarchical matrix of one level [Hac15], coded like a picture:
//
// 1. Neighbouring patches that face the same direction make clusters of 64.
// 2. Each cluster gets the basis in which its rows have most of their energy in few coefficients
//    (principal components), rounded to 8 bits. All of the matrix becomes T, K = Q^T T Q, K the
//    balanced matrix; the dual of Q makes up for its rounding.
// 3. The three channels, which differ only in later bounces, become three axes, two of them small.
// 4. Tiles of 4 × 4 coefficients are dropped or stored with 4, 8 or 16 bits: whatever is least of
//    distortion + λ bytes. λ is found for the requested error.
//
// Distortion counts by the light that a coefficient is likely to meet: direct light falls on
// patches much as light from other patches does, but has more detail than light of all bounces. The
// root of the energy of T's rows was best among its powers, by bytes for the same error of real
// direct light.

#include "solve/matrix/compressed_tiles.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "solve/matrix/balanced.h"
#include "solve/matrix/clusters.h"
#include "solve/matrix/half.h"
#include "solve/matrix/local_bases.h"

namespace lumel {
namespace {

constexpr std::size_t kTileRowsPerTask = 16;
constexpr int kSearchSteps = 40;  // halvings of λ's logarithm

/// The estimate of an error by `expected_light` is this part of what real direct light shows, by
/// `lumel-papers matrix`.
constexpr double kEstimateOfError = 0.6;
constexpr int kDropped = kPrecisions;  // the precision of tiles that are not stored

double tile_bytes(int precision)
{
    constexpr double place_bytes = 4.0;
    return precision == kDropped
               ? 0.0
               : place_bytes + double(kTileTexels * kTileBits[std::size_t(precision)]) / 8.0;
}

Tile tile_of(const Coefficients& matrix, int axis, std::size_t row, std::size_t column)
{
    Tile tile;
    for (std::size_t i = 0; i < kTileTexels; ++i)
        tile[i] =
            matrix.axis[axis][(row * kTile + i / kTile) * matrix.side + column * kTile + i % kTile];
    return tile;
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
    const std::size_t rows = matrix.side / kTile;
    std::vector<Loss> result(3 * rows * rows);
    parallel_for(3 * rows, kTileRowsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column <= row % rows; ++column) {
                const Tile tile = tile_of(matrix, int(row / rows), row % rows, column);
                for (std::size_t kind = 0; kind <= kPrecisions; ++kind) {
                    const Tile stored =
                        kind < kPrecisions ? decode(encode(tile, unit, kind), unit, kind) : Tile{};
                    for (std::size_t i = 0; i < kTileTexels; ++i) {
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

void begin_row(TiledMatrix& tiled, std::size_t axis)
{
    for (std::array<TileRows, 3>& axes : tiled.tiles)
        axes[axis].first.push_back(std::uint32_t(axes[axis].place.size()));
}

void store(TiledMatrix& tiled, const Coefficients& matrix, std::span<const Loss> losses,
           double lambda)
{
    const std::size_t rows = matrix.side / kTile;
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
                append(tiled.tiles[precision][axis],
                       encode(tile_of(matrix, int(axis), row, column), tiled.unit, precision),
                       column, precision);
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

/// Adds the tiles to one axis of T.
void load(const TileRows& tiles, float unit, std::size_t precision, std::size_t side,
          std::vector<float>& values)
{
    for (std::size_t row = 0; row + 1 < tiles.first.size(); ++row)
        for (std::size_t tile = tiles.first[row]; tile < tiles.first[row + 1]; ++tile) {
            const std::size_t column = tiles.place[tile] & 0xffffu;
            const Tile entries = decode(tile_at(tiles, tile, precision), unit, precision);
            for (std::size_t i = 0; i < kTileTexels; ++i) {
                const std::size_t r = row * kTile + i / kTile, c = column * kTile + i % kTile;
                values[r * side + c] = values[c * side + r] = entries[i];
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
    if (whole_clusters(matrix.size()) / kTile > 0x10000u)
        throw Error(ErrorKind::input, "form-factor matrix", "is too large; use fewer patches");
    TiledMatrix tiled{.size = matrix.size()};
    const ColorMatrix balance = balanced(matrix, elements);
    tiled.order = cluster_order(elements, kCluster);
    tiled.color = elements.color;
    tiled.root_area = root_areas(elements);
    Coefficients coefficients = by_axes(balance, tiled.order);
    symmetrise(coefficients);
    const CodedBasis bases = find_bases(coefficients);
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
    Coefficients coefficients{whole_clusters(n), {}};
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
                        kColorAxes[a][c] * coefficients.axis[a][i * coefficients.side + j];
    }
    return unbalanced(result, tiled.color, tiled.root_area);
}

std::array<std::array<TileRows, 3>, kPrecisions> both_halves(const TiledMatrix& tiled)
{
    std::array<std::array<TileRows, 3>, kPrecisions> all;
    for (std::size_t precision = 0; precision < kPrecisions; ++precision)
        for (std::size_t axis = 0; axis < 3; ++axis)
            all[precision][axis] = with_mirror_images(tiled.tiles[precision][axis], precision);
    return all;
}

}  // namespace lumel
