// The form's number, then the state of the form. Values are checked before they are used as
// indices.

#include "solve/matrix/stored.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "base/core/error.h"
#include "base/core/state_bytes.h"

namespace lumel {
namespace {

/// Numbers of forms. 0, codes of single entries, 1, low rank, and 3, BC1 with rows and columns in
/// orders of their own, are no longer read.
constexpr std::uint32_t kTiles = 2, kBc1 = 4;

constexpr bool is_no_longer_read(std::uint32_t form)
{
    return form < kBc1 && form != kTiles;
}

bool is_permutation(const std::vector<std::uint32_t>& order, std::size_t size)
{
    std::vector<std::uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (sorted[i] != i)
            return false;
    return order.size() == size;
}

bool is_sound(const SparsePart& exact, std::size_t size)
{
    bool sound = exact.size == size && exact.per_row <= size;
    for (std::size_t c = 0; c < 3; ++c)
        sound = sound && exact.column[c].size() == size * exact.per_row &&
                exact.value[c].size() == size * exact.per_row &&
                std::all_of(exact.column[c].begin(), exact.column[c].end(),
                            [&](std::uint16_t column) { return column < size; });
    return sound;
}

bool is_sound(const Bc1Matrix& matrix)
{
    const LogDecoding& decoding = matrix.decoding;
    const std::size_t size = decoding.size, side = filled_up(decoding.size) / kBlockSide;
    return size <= kMaxColumns && matrix.blocks.size() == side * side * 2 &&
           std::isfinite(decoding.offset) &&
           std::all_of(decoding.largest.begin(), decoding.largest.end(),
                       [](float largest) { return std::isfinite(largest); }) &&
           (decoding.order.empty() || is_permutation(decoding.order, size)) &&
           is_sound(decoding.exact, size);
}

bool is_sound(const TileRows& tiles, std::size_t rows, std::size_t bits)
{
    if (tiles.first.size() != rows + 1 || tiles.first.front() != 0 ||
        !std::is_sorted(tiles.first.begin(), tiles.first.end()) ||
        tiles.first.back() != tiles.place.size() ||
        tiles.codes.size() != tiles.place.size() * kTileTexels * bits / 32)
        return false;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t tile = tiles.first[row]; tile < tiles.first[row + 1]; ++tile)
            if ((tiles.place[tile] & 0xffffu) > row)
                return false;
    return true;
}

bool is_sound(const TiledMatrix& matrix)
{
    const std::size_t n = matrix.size, clusters = (n + kCluster - 1) / kCluster;
    const auto is_coefficients = [](std::uint32_t kept) {
        return kept <= kCluster && kept % kTile == 0;
    };
    if (!is_permutation(matrix.order, n) || matrix.color.size() != n ||
        matrix.root_area.size() != n ||
        !std::all_of(matrix.root_area.begin(), matrix.root_area.end(),
                     [](float root) { return root > 0.0f && std::isfinite(root); }) ||
        matrix.kept.size() != clusters || !std::isfinite(matrix.unit) ||
        !std::all_of(matrix.kept.begin(), matrix.kept.end(), is_coefficients))
        return false;
    const std::size_t rows =
        std::accumulate(matrix.kept.begin(), matrix.kept.end(), std::size_t(0));
    bool sound = matrix.basis_unit.size() == rows && matrix.basis.size() == rows * kCluster;
    for (std::size_t precision = 0; precision < kPrecisions; ++precision)
        for (const TileRows& tiles : matrix.tiles[precision])
            sound = sound && is_sound(tiles, clusters * kCluster / kTile, kTileBits[precision]);
    return sound;
}

template <class Form>
CompressedMatrix read(StateReader& reader)
{
    Form form;
    reader(form);
    if (!reader.at_end() || !is_sound(form))
        reader.fail();
    return form;
}

}  // namespace

std::string to_bytes(const CompressedMatrix& matrix)
{
    std::ostringstream bytes;
    StateWriter writer(bytes);
    writer(std::holds_alternative<Bc1Matrix>(matrix) ? kBc1 : kTiles);
    std::visit([&](const auto& form) { writer(form); }, matrix);
    return std::move(bytes).str();
}

CompressedMatrix from_bytes(const std::string& bytes, const std::string& where)
{
    std::istringstream stream(bytes);
    StateReader reader(stream, bytes.size(), where, kMatrixDamage);
    std::uint32_t form = 0;
    reader(form);
    if (is_no_longer_read(form))
        throw Error(ErrorKind::input, where,
                    "holds a matrix in a form that is no longer read; bake the scene again");
    if (form > kBc1)
        reader.fail();
    return form == kBc1 ? read<Bc1Matrix>(reader) : read<TiledMatrix>(reader);
}

}  // namespace lumel
