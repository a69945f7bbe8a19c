#pragma once
// Any stored form of a color matrix.

#include <variant>

#include "solve/matrix/coded_matrix.h"
#include "solve/matrix/compressed_low_rank.h"
#include "solve/matrix/compressed_tiles.h"

namespace lumel {

using CompressedMatrix = std::variant<CodedMatrix, LowRankMatrix, TiledMatrix>;

inline std::uint32_t size_of(const CompressedMatrix& matrix)
{
    return std::visit([](const auto& form) { return form.size; }, matrix);
}

inline std::size_t bytes_of(const CompressedMatrix& matrix)
{
    return std::visit([](const auto& form) { return form.bytes(); }, matrix);
}

}  // namespace lumel
