#pragma once
// The record and report of a bake and the report of a reference.

#include "jobs/bake/outputs.h"
#include "results/record/bake_record.h"

namespace lumel {

struct ReferenceOptions;

/// What a bake is. exposure: of lightmap.png.
BakeRecord record_of(const BakeOptions& options, const Prepared& prepared, const Results& results,
                     const WrittenLight& written);

/// From where preview.png shows the scene; nothing if there is no preview.
std::optional<PreviewRow> preview_row(const WrittenLight& written, const Scene& scene);

/// The facts of a bake.
Report bake_report(const BakeRecord& record, const Prepared& prepared, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages);

/// The facts of a reference.
Report reference_report(const BakeOptions& options, const ReferenceOptions& reference,
                        const Prepared& prepared, bool stopped, const Stages& stages);

}  // namespace lumel
