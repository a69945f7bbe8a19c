#pragma once
// What would help a scene most, in a few sentences.

#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/stages.h"
#include "solve/solver/solver_state.h"

namespace lumel {

/// Up to three sentences of advice, each with what helps: on an object that is inside out; on a sky
/// that is far too dark beside the sun; on an object with most of the lumels that reaches far
/// beyond all others, unless densities are chosen; and on back sides.
std::vector<std::string> advice(const SolveScene& prepared, const AtlasOptions& chosen);

/// A sentence on lumels without any light, if they are a large share of the map: the outside of a
/// room takes texels from its inside. irradiance: [N]. Empty if nothing is lit.
std::string of_dark_lumels(const SolveScene& prepared, const AtlasOptions& chosen,
                           const std::vector<glm::vec3>& irradiance);

/// A sentence on where noise is still seen, at most three names; empty if nothing has one.
std::string where_it_is_noisy(const Scene& scene, const std::vector<NoisySurface>& surfaces);

/// True if any light arrives.
bool is_lit(const std::vector<glm::vec3>& irradiance);

/// After a solve: warns if no light arrives although there are sources, and gives advice().
void tell_advice(const SolveScene& prepared, const BakeOptions& options, const Solution& solution,
                 Stages& stages);

}  // namespace lumel
