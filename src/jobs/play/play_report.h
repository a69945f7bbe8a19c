#pragma once
// Report of a film.

#include <vector>

#include "jobs/bake/outputs.h"
#include "jobs/play/played_light.h"

namespace lumel {

/// The facts of a film. height: of the pictures [pixels].
Report play_report(const PlayOptions& options, const PlayedLight& light, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages);

}  // namespace lumel
