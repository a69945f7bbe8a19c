#pragma once
// Pictures side by side.

#include <vector>

#include "base/core/image.h"

namespace lumel::bench {

/// Pictures of one size in rows, the first not empty; shorter rows end in black.
Image contact_sheet(const std::vector<std::vector<Image>>& rows);

}  // namespace lumel::bench
