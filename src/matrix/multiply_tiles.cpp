#include "matrix/multiply_tiles.h"

#include "matrix/balanced.h"
#include "matrix/multiply_tiles.shared.h"

namespace lumel {
namespace {

constexpr std::uint32_t kProjectSpirv[] = {
#include "matrix/multiply_tiles.project.comp.inc"
};
constexpr std::uint32_t kProductSpirv[] = {
#include "matrix/multiply_tiles.product.comp.inc"
};
constexpr std::uint32_t kExpandSpirv[] = {
#include "matrix/multiply_tiles.expand.comp.inc"
};

using Words = std::vector<std::uint32_t>;

gpu::Array<std::uint32_t> on_device(const gpu::Device& device, const Words& words)
{
    return gpu::Array<std::uint32_t>(device, std::span<const std::uint32_t>(words));
}

Words first_basis(const TiledMatrix& matrix)
{
    Words first = {0};
    for (const std::uint32_t kept : matrix.kept)
        first.push_back(first.back() + kept);
    return first;
}

Words basis_words(const TiledMatrix& matrix)
{
    Words words(matrix.basis.size() / 2);
    for (std::size_t i = 0; i < matrix.basis.size(); ++i)
        words[i / 2] |= std::uint32_t(matrix.basis[i]) << (16 * (i % 2));
    return words;
}

Words all_firsts(const TiledMatrix& matrix)
{
    Words words;
    for (const auto* kind : {&matrix.fine, &matrix.coarse}) {
        std::uint32_t before = 0;
        for (const TileRows& rows : *kind) {
            for (const std::uint32_t first : rows.first)
                words.push_back(before + first);
            before += std::uint32_t(rows.place.size());
        }
    }
    return words;
}

/// One after the other, of all axes.
Words joined(const std::array<TileRows, 3>& axes, std::vector<std::uint32_t> TileRows::*part)
{
    Words words;
    for (const TileRows& rows : axes)
        words.insert(words.end(), (rows.*part).begin(), (rows.*part).end());
    return words;
}

std::size_t plane_floats(const TiledMatrix& matrix, std::uint32_t states)
{
    return std::size_t(states) * 3 * matrix.clusters() * kCluster;
}

}  // namespace

MultiplyTiles::MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix,
                             std::uint32_t states)
    : clusters_(matrix.clusters()),
      unit_(matrix.unit),
      in_(device, plane_floats(matrix, states)),
      seen_(device, plane_floats(matrix, states)),
      sent_(device, plane_floats(matrix, states)),
      out_(device, plane_floats(matrix, states)),
      gather_(device, matrix.size, clusters_ * kCluster, matrix.order,
              sent_weights(matrix.color, matrix.root_area)),
      first_basis_(on_device(device, first_basis(matrix))),
      basis_(on_device(device, basis_words(matrix))),
      first_(on_device(device, all_firsts(matrix))),
      fine_place_(on_device(device, joined(matrix.fine, &TileRows::place))),
      fine_(on_device(device, joined(matrix.fine, &TileRows::codes))),
      coarse_place_(on_device(device, joined(matrix.coarse, &TileRows::place))),
      coarse_(on_device(device, joined(matrix.coarse, &TileRows::codes))),
      scatter_(device, matrix.size, clusters_ * kCluster, matrix.order,
               received_weights(matrix.root_area), {}),
      project_(device, "multiply_tiles.project", kProjectSpirv, 4, sizeof(TileParams), kCluster),
      product_(device, "multiply_tiles.product", kProductSpirv, 7, sizeof(TileParams), kTileGroup),
      expand_(device, "multiply_tiles.expand", kExpandSpirv, 4, sizeof(TileParams), kCluster)
{
}

void MultiplyTiles::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                           const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    const TileParams params{clusters_, states, unit_};
    const std::size_t patches = std::size_t(states) * clusters_ * kCluster;
    gather_.record(commands, x, in_, states);
    commands.dispatch(project_, {first_basis_, basis_, in_, seen_}, params, patches);
    commands.dispatch(product_, {first_, fine_place_, fine_, coarse_place_, coarse_, seen_, sent_},
                      params, patches / kTile * kTileLanes);
    commands.dispatch(expand_, {first_basis_, basis_, sent_, out_}, params, patches);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel
