#pragma once
// Light of a scene with separate sources, for lumel relight.

#include "jobs/solve/lighting.h"

namespace lumel {

/// True if these options keep the light of every source separate.
bool keeps_sources_apart(const BakeOptions& options);

/// Loads the libraries that only these options need. Throws Error{input} if one is missing.
void open_libraries(const BakeOptions& options);

/// Atlas options, with sides that share texels if sources are separate: scene.lumelmat has one
/// texel for both. Throws Error{input} for Sides::both then.
AtlasOptions atlas_that_fits(const BakeOptions& options);

/// Solves for options.parts of the light, source by source. Sets Solution::relightable if these are
/// all and nothing stopped it.
std::unique_ptr<Solution> solve_sources(const gpu::Device& device, const Setting& setting,
                                        const BakeOptions& options, Stages& stages);

}  // namespace lumel
