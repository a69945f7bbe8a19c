#pragma once
// A color matrix in any form: those of src/solve/matrix and those that they are compared with.

#include <variant>

#include "bench/papers/matrix_codes.h"
#include "bench/papers/matrix_hierarchy.h"
#include "bench/papers/matrix_low_rank.h"
#include "solve/matrix/compressed_tiles.h"

namespace lumel::bench {

using AnyMatrix = std::variant<CodedMatrix, LowRankMatrix, HierarchicalMatrix, TiledMatrix>;

inline std::size_t bytes_of(const AnyMatrix& matrix)
{
    return std::visit([](const auto& form) { return form.bytes(); }, matrix);
}

/// As a user of the form gets it.
inline ColorMatrix whole(const AnyMatrix& matrix)
{
    if (const auto* coded = std::get_if<CodedMatrix>(&matrix))
        return decode(*coded);
    if (const auto* low_rank = std::get_if<LowRankMatrix>(&matrix))
        return decompress(*low_rank);
    if (const auto* blocks = std::get_if<HierarchicalMatrix>(&matrix))
        return decompress(*blocks);
    return decompress(std::get<TiledMatrix>(matrix));
}

}  // namespace lumel::bench
