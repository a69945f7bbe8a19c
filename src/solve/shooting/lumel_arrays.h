#pragma once
// What every solver takes of the lumels. Buried lumels neither shine nor reflect: their area and
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

/// Lumels that shine but reflect nothing.
Lumels black(Lumels lumels);

/// Σ A of lumels that reflect [m²]
float reflecting_area(const Lumels& lumels);

/// Share of the area that shines by itself. known: [N] [lx] of light whose reflection the emission
/// contains too, or empty.
float emissive_share(const Lumels& lumels, std::span<const glm::vec3> known);

/// Σ A 𝓛(E) [lm]; emission [N] as of emission_of.
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
