#pragma once
// Report of an animation.

#include <vector>

#include "jobs/bake/outputs.h"
#include "jobs/play/played_light.h"

namespace lumel {

/// Report of an animation. height: of the images [pixels].
Report play_report(const PlayOptions& options, const PlayedLight& light, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages);

}  // namespace lumel
