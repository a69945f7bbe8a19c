#pragma once
// Report of an animation.

#include <vector>

#include "jobs/bake/outputs.h"
#include "jobs/play/play.h"

namespace lumel {

/// A played animation.
struct Played {
    const Scene& scene;
    const Atlas& atlas;
    const Lumels& lumels;
    const gpu::StageTimes& times;
    std::uint64_t shots;
};

/// Report of an animation. height: of the images [pixels].
Report play_report(const PlayOptions& options, const Played& played, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages);

}  // namespace lumel
