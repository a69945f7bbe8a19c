#pragma once
// Pictures of a form-factor matrix, and of what it lights.

#include <string>

#include "bench/papers/matrix_case.h"

namespace lumel::bench {

/// [SF17] figures 3 and 4: how the logarithms of the entries that BC1 stores are distributed.
void add_logarithms(Report& report, const MatrixCase& matrix_case);

/// [SF17] figures 5 and 8 to 10: the logarithms before compression, from blocks after both
/// reorderings, and how far these are off, in red and in all colours. Side by side in `folder`.
void draw_matrix(Report& report, const MatrixCase& matrix_case, const std::string& folder);

/// [SF17] figure 13: the scene by `--solver matrix` and by paths, from one eye. Throws Error.
void draw_beside_paths(const gpu::Device& device, const Settings& settings, std::uint32_t patches,
                       int width, const std::string& folder, Report& report);

}  // namespace lumel::bench
