#pragma once
// Report of a film.

#include <vector>

#include "jobs/bake/outputs.h"
#include "jobs/play/play.h"

namespace lumel {

/// What was played.
struct Played {
    const Scene& scene;
    const Atlas& atlas;
    const Lumels& lumels;
    const gpu::StageTimes& times;
    std::uint64_t shots;
};

/// The facts of a film. height: of the pictures [pixels].
Report play_report(const PlayOptions& options, const Played& played, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages);

}  // namespace lumel
