#pragma once
// Lumel attributes as arrays for solvers. Buried lumels neither emit nor reflect: their area and
// emission are 0.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/core/luminance.h"

namespace lumel {

/// (ρ, A) [N]
std::vector<glm::vec4> surfaces_of(const Lumels& lumels);

/// E [N] [lm/m²]
std::vector<glm::vec3> emission_of(const Lumels& lumels);

/// Makes all albedos 0.
Lumels black(Lumels lumels);

/// Σ A of reflecting lumels [m²]
float reflecting_area(const Lumels& lumels);

/// Area of lumels that emit on their own relative to all. known: irradiance [N] [lx] whose
/// reflection the emission also contains, or empty.
float emissive_share(const Lumels& lumels, std::span<const glm::vec3> known);

/// Σ A 𝓛(E) [lm]; emission: [N] from emission_of().
double emitted_power(const Lumels& lumels, std::span<const glm::vec3> emission);

template <class T>
std::span<const T> view(const std::vector<T>& values)
{
    return values;
}

/// Adds `more` [N] [lx] to `sum`; nothing if it is empty.
void add_light(std::vector<glm::vec3>& sum, std::span<const glm::vec3> more);

/// Σ H over lumels and channels [lx].
double irradiance_sum(std::span<const glm::vec3> irradiance);

}  // namespace lumel
