#pragma once
// How loops over the rows of a matrix are cut into tasks.

#include <cstddef>

namespace lumel {

/// Minimum: a row of a few thousand numbers takes microseconds.
inline constexpr std::size_t kRowsPerTask = 16;

}  // namespace lumel
