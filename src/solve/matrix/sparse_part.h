#pragma once
// The few entries of a matrix that are kept as they are.

#include "solve/matrix/color_matrix.h"

namespace lumel {

/// Columns that 16 bits can name.
inline constexpr std::uint32_t kMaxColumns = 0x10000u;

/// For each channel and row the same number of entries.
struct SparsePart {
    std::uint32_t size = 0;     ///< rows and columns of the matrix, at most kMaxColumns
    std::uint32_t per_row = 0;  ///< entries in a row of a channel
    std::array<std::vector<std::uint16_t>, 3> column;  ///< [size][per_row], ascending in a row
    std::array<std::vector<float>, 3> value;           ///< [size][per_row]

    /// For StateWriter and StateReader.
    template <class Archive>
    void state(Archive& archive)
    {
        archive(size, per_row, column, value);
    }
    std::size_t bytes() const
    {
        return 3 * std::size_t(size) * per_row * (sizeof(std::uint16_t) + sizeof(float));
    }
};

/// The largest `share` (0…1) of each row of each channel. Throws Error{input} if the matrix has
/// more columns than 16 bits can name.
SparsePart largest_entries(const ColorMatrix& matrix, float share);

/// matrix + part, entry by entry.
void add(ColorMatrix& matrix, const SparsePart& part);

}  // namespace lumel
