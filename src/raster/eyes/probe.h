#pragma once
// Visibility between eyes and points, read back for tests and benchmarks.

#include <vector>

#include "raster/eyes/eye_views.h"
#include "raster/eyes/probe.shared.h"

namespace lumel {

/// An eye at a surface point with an arbitrary rotation about the normal (length 1).
Eye eye_at(const glm::vec3& position, const glm::vec3& normal);

/// Tests every point from every eye. Blocks. eyes: on the GPU, those of the last look_from() of
/// `views`. Returns [eyes][questions], 1: visible.
std::vector<std::vector<std::uint32_t>> ask(const gpu::Device& device, const EyeViews& views,
                                            const gpu::Array<Eye>& eyes,
                                            const gpu::Array<Question>& questions);

}  // namespace lumel
