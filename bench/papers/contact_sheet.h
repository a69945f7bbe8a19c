#pragma once
// Pictures side by side.

#include <vector>

#include "base/core/image.h"

namespace lumel::bench {

/// Pictures of one size in rows, of which the first is the longest.
Image contact_sheet(const std::vector<std::vector<Image>>& rows);

}  // namespace lumel::bench
