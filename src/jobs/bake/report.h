#pragma once
// Record and report of a bake, and report of a reference.

#include "jobs/bake/outputs.h"
#include "results/record/bake_record.h"

namespace lumel {

struct ReferenceOptions;

/// Record of a bake. written.exposure: of lightmap.png.
BakeRecord record_of(const BakeOptions& options, const SolveScene& prepared, const Results& results,
                     const WrittenLight& written);

/// View of preview.png; empty without a preview.
std::optional<PreviewRow> preview_row(const WrittenLight& written, const Scene& scene);

Report bake_report(const BakeRecord& record, const SolveScene& prepared, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages);

Report reference_report(const BakeOptions& options, const ReferenceOptions& reference,
                        const SolveScene& prepared, bool stopped, const Stages& stages);

}  // namespace lumel
