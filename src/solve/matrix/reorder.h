#pragma once
// Bringing like rows and like columns together [SF17 section 3.5].

#include <cstdint>
#include <span>
#include <vector>

namespace lumel {

/// Lines of the matrix by which patches are ordered. A row is swapped together with its column and
/// its patch [SF17 figure 6].
enum class Reordering : std::uint8_t {
    none,
    rows,
    rows_and_columns,  ///< by rows, then by columns, which replaces the first order
};

/// Greedy: the first row stays, the row most like it (Euclidean distance) follows, and so on.
/// rows: [count][length]. Place p of the result names the row that goes there.
std::vector<std::uint32_t> order_by_likeness(std::span<const float> rows, std::uint32_t count,
                                             std::uint32_t length);

}  // namespace lumel
