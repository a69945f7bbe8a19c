#pragma once
// What bakes, pictures and films have to say of themselves.

#include "bake/outputs.h"
#include "bake/play.h"
#include "bake/render.h"
#include "bake/update.h"
#include "record/bake_record.h"

namespace lumel {

struct ReferenceOptions;

/// What a bake is. exposure: of lightmap.png.
BakeRecord record_of(const BakeOptions& options, const Prepared& prepared, const Results& results,
                     const WrittenLight& written);

/// From where preview.png shows the scene; nothing if there is no preview.
std::optional<PreviewRow> preview_row(const WrittenLight& written, const Scene& scene);

/// What a bake is once it was corrected. written: if light was written anew.
BakeRecord corrected(BakeRecord baked, const UpdateOptions& options, const UpdateRow& row,
                     const Prepared& prepared, const std::optional<WrittenLight>& written,
                     bool interrupted);

/// The facts of a bake.
Report bake_report(const BakeRecord& record, const Prepared& prepared, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages);

/// The facts of a bake that was corrected. device: of the preview and of lights, or none.
Report update_report(const BakeRecord& record, const UpdateRow& row, const Prepared& prepared,
                     const gpu::Device* device, const Stages& stages);

/// The facts of a reference.
Report reference_report(const BakeOptions& options, const ReferenceOptions& reference,
                        const Prepared& prepared, bool stopped, const Stages& stages);

/// The facts of a picture of a solved scene. options.height: as the picture is.
Report picture_report(const RenderOptions& options, const Prepared& prepared,
                      const gpu::Device& device, const Solver& solver, const Results& results,
                      const Stages& stages);

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

/// The facts of a path-traced picture. options.height: as the picture is.
Report path_traced_report(const RenderOptions& options, const Scene& scene, const Stages& stages);

}  // namespace lumel
