#pragma once
// What a solution is compared with.

#include <optional>

#include "base/core/image.h"
#include "bench/settings.h"

namespace lumel::bench {

/// The irradiance map that the settings name, or path traced by them. Empty: none.
std::optional<Image> reference_map(const Settings& settings, const SolveScene& world);

}  // namespace lumel::bench
