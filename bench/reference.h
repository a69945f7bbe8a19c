#pragma once
// What a solution is compared with.

#include <optional>

#include "base/core/image.h"
#include "bench/settings.h"

namespace lumel::bench {

/// The irradiance map that the settings name, or path traced by them. Empty: none. half: maps of
/// different numbers have independent paths.
std::optional<Image> reference_map(const Settings& settings, const SolveScene& world,
                                   std::uint32_t half = 0);

}  // namespace lumel::bench
