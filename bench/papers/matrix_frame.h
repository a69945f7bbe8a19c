#pragma once
// Time of a frame in which a lamp moves [SF17 sections 3.6, 4.3].

#include "bench/papers/figures.h"
#include "gpu/device.h"

namespace lumel::bench {

/// Steps of the paper's frame: the lamp's shadow maps and emission of patches, the multiply and its
/// light on the scene, and a picture. The mean of the settings' repeats, the first frame left out.
/// Throws Error.
void add_frame(Report& report, const gpu::Device& device, const MatrixSpeedSettings& settings);

}  // namespace lumel::bench
