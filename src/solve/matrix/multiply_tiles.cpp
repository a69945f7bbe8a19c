#include "solve/matrix/multiply_tiles.h"

#include "solve/matrix/balanced.h"
#include "solve/matrix/multiply_tiles.shared.h"

namespace lumel {
namespace {

using Words = std::vector<std::uint32_t>;

gpu::Array<std::uint32_t> on_device(const gpu::Device& device, const Words& words,
                                    const gpu::Name& name = gpu::Name::of_line())
{
    return gpu::Array<std::uint32_t>(device, std::span<const std::uint32_t>(words), name);
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
    Words words(matrix.basis.size() / 4);
    for (std::size_t i = 0; i < matrix.basis.size(); ++i)
        words[i / 4] |= std::uint32_t(std::uint8_t(matrix.basis[i])) << (8 * (i % 4));
    return words;
}

using AllTiles = std::array<std::array<TileRows, 3>, kPrecisions>;

Words all_firsts(const AllTiles& tiles)
{
    Words words;
    std::uint32_t before = 0;
    for (const std::array<TileRows, 3>& axes : tiles)
        for (const TileRows& rows : axes) {
            for (const std::uint32_t first : rows.first)
                words.push_back(before + first);
            before += std::uint32_t(rows.place.size());
        }
    return words;
}

Words all_places(const AllTiles& tiles)
{
    Words words;
    for (const std::array<TileRows, 3>& axes : tiles)
        for (const TileRows& rows : axes)
            words.insert(words.end(), rows.place.begin(), rows.place.end());
    return words;
}

/// Of one precision, all axes.
Words codes_of(const std::array<TileRows, 3>& axes)
{
    Words words;
    for (const TileRows& rows : axes)
        words.insert(words.end(), rows.codes.begin(), rows.codes.end());
    return words;
}

std::size_t plane_floats(const TiledMatrix& matrix, std::uint32_t states)
{
    return std::size_t(states) * 3 * matrix.clusters() * kCluster;
}

}  // namespace

MultiplyTiles::MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix,
                             std::uint32_t states)
    : MultiplyTiles(device, matrix, both_halves(matrix), states)
{
}

MultiplyTiles::MultiplyTiles(const gpu::Device& device, const TiledMatrix& matrix,
                             const AllTiles& tiles, std::uint32_t states)
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
      basis_unit_(device, std::span<const float>(matrix.basis_unit)),
      first_(on_device(device, all_firsts(tiles))),
      place_(on_device(device, all_places(tiles))),
      codes4_(on_device(device, codes_of(tiles[0]))),
      codes8_(on_device(device, codes_of(tiles[1]))),
      codes16_(on_device(device, codes_of(tiles[2]))),
      scatter_(device, matrix.size, clusters_ * kCluster, matrix.order,
               received_weights(matrix.root_area), {}),
      project_(device),
      product_(device),
      expand_(device)
{
}

void MultiplyTiles::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                           const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    const TileParams params{clusters_, states, unit_};
    const std::size_t patches = std::size_t(states) * clusters_ * kCluster;
    gather_.record(commands, x, in_, states);
    commands.dispatch(project_,
                      {.first_basis = first_basis_,
                       .basis = basis_,
                       .unit = basis_unit_,
                       .patches = in_,
                       .coefficients = seen_},
                      params, patches);
    commands.dispatch(product_,
                      {.first = first_,
                       .place = place_,
                       .codes4 = gpu::packed(codes4_),
                       .codes8 = gpu::packed(codes8_),
                       .codes16 = gpu::packed(codes16_),
                       .seen = gpu::packed(seen_),
                       .sent = gpu::packed(sent_)},
                      params, patches / kTile * kTileLanes);
    commands.dispatch(expand_,
                      {.first_basis = first_basis_,
                       .basis = basis_,
                       .unit = basis_unit_,
                       .coefficients = sent_,
                       .patches = out_},
                      params, patches);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel
