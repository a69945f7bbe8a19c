#pragma once
// A color matrix in the form that a user chose.

#include <variant>

#include "solve/matrix/compressed_bc1.h"
#include "solve/matrix/compressed_tiles.h"

namespace lumel {

using CompressedMatrix = std::variant<TiledMatrix, Bc1Matrix>;

inline std::uint32_t size_of(const CompressedMatrix& matrix)
{
    const auto* bc1 = std::get_if<Bc1Matrix>(&matrix);
    return bc1 ? bc1->decoding.size : std::get<TiledMatrix>(matrix).size;
}

inline std::size_t bytes_of(const CompressedMatrix& matrix)
{
    return std::visit([](const auto& form) { return form.bytes(); }, matrix);
}

}  // namespace lumel
