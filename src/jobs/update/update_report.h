#pragma once
// The record and report of a bake that `lumel update` has corrected.

#include <optional>

#include "jobs/bake/outputs.h"
#include "jobs/update/update.h"
#include "results/record/bake_record.h"

namespace lumel {

/// What a bake is once it was corrected. written: if light was written anew.
BakeRecord corrected(BakeRecord baked, const UpdateOptions& options, const UpdateRow& row,
                     const Prepared& prepared, const std::optional<WrittenLight>& written,
                     bool interrupted);

/// The facts of a bake that was corrected. device: of the preview and of lights, or none.
Report update_report(const BakeRecord& record, const UpdateRow& row, const Prepared& prepared,
                     const gpu::Device* device, const Stages& stages);

}  // namespace lumel
