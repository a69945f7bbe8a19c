#pragma once
// A color matrix in local bases, of which only few coefficients matter: the smallest form.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/elements.h"
#include "solve/matrix/tiles.h"

namespace lumel {

struct TileOptions {
    /// Relative error to aim at, of indirect light where direct light comes from anywhere.
    float error = 0.01f;
};

/// M = D^-1 Q^T T Q D C: colours C, D = √area, a basis Q for each cluster of patches, and T made of
/// three sparse, symmetric matrices of 4 × 4 tiles, one for each axis of colours.
struct TiledMatrix {
    std::uint32_t size = 0;
    std::vector<std::uint32_t> order;  ///< [size] the patch at each place; clusters lie together
    std::vector<std::uint32_t> kept;   ///< [clusters] coefficients in use, a multiple of 4
    std::vector<std::int8_t> basis;    ///< for each cluster [kept][kCluster], in kCodes8 of a unit
    std::vector<float> basis_unit;     ///< of each row of `basis`
    std::vector<glm::vec3> color;      ///< [size], the caller's order
    std::vector<float> root_area;      ///< [size] √area, the caller's order
    float unit = 1.0f;                 ///< what a half float 1 means in a tile
    std::array<std::array<TileRows, 3>, kPrecisions> tiles;  ///< [precision][axis], column ≤ row

    template <class Archive>
    void state(Archive& archive)
    {
        archive(size, order, kept, basis, basis_unit, color, root_area, unit, tiles);
    }
    std::uint32_t clusters() const { return std::uint32_t(kept.size()); }
    std::size_t bytes() const;
};

/// Takes the symmetric part of the balanced matrix. Throws Error{input} if the matrix is too large,
/// or if elements are missing.
TiledMatrix compress_tiles(const ColorMatrix& matrix, const Elements& elements,
                           const TileOptions& options);
ColorMatrix decompress(const TiledMatrix& tiled);

/// All tiles, those above the diagonal too, columns ascending.
std::array<std::array<TileRows, 3>, kPrecisions> both_halves(const TiledMatrix& tiled);

}  // namespace lumel
