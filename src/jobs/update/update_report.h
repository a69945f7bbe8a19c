#pragma once
// Record and report of a bake corrected by `lumel update`.

#include <optional>

#include "jobs/bake/outputs.h"
#include "jobs/update/update.h"
#include "results/record/bake_record.h"

namespace lumel {

/// Record after a correction. written: if light was rewritten.
BakeRecord corrected(BakeRecord baked, const UpdateOptions& options, const UpdateRow& row,
                     const SolveScene& prepared, const std::optional<WrittenLight>& written,
                     bool interrupted);

/// Report of a corrected bake. device: of the preview and of lights, or null.
Report update_report(const BakeRecord& record, const UpdateRow& row, const SolveScene& prepared,
                     const gpu::Device* device, const Stages& stages);

}  // namespace lumel
