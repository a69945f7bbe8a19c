#pragma once
// A scene's light with its sources apart, for lumel relight.

#include "jobs/solve/lighting.h"

namespace lumel {

/// True if these options keep the light of every source apart.
bool keeps_sources_apart(const BakeOptions& options);

/// The options of an atlas, with sides that share their texels where sources are kept apart:
/// scene.lumelmat has one place for both. Throws Error{input} for Sides::both there.
AtlasOptions atlas_that_fits(const BakeOptions& options);

/// Solves for the parts of the light that options.parts names, source by source.
/// Solution::relightable is there if that is all, and nothing stopped it.
std::unique_ptr<Solution> solve_sources(const gpu::Device& device, const Setting& setting,
                                        const BakeOptions& options, Stages& stages);

}  // namespace lumel
