#include "jobs/update/update_report.h"

#include <cmath>

#include "jobs/bake/report_parts.h"
#include "links/kept/links_file.h"

namespace lumel {

BakeRecord corrected(BakeRecord baked, const UpdateOptions& options, const UpdateRow& row,
                     const SolveScene& prepared, const std::optional<WrittenLight>& written,
                     bool interrupted)
{
    baked.scene = file_of(prepared.scene);
    baked.scene_hash = prepared.scene.hash;
    baked.lights = options.lights;
    baked.pages = prepared.atlas.pages;
    baked.texels_per_metre = double(prepared.atlas.texels_per_metre);
    if (row.solved_anew)
        baked.error = row.residual;
    else if (baked.error >= 0.0)
        baked.error = std::hypot(baked.error, row.residual);
    baked.interrupted = interrupted;
    if (written)
        baked.exposure = written->exposure;
    baked.files = baked_files(prepared.atlas.pages);
    if (written && written->view)
        baked.files.emplace_back(kPreview);
    if (baked.keep_links > 0)
        baked.files.emplace_back(kLinksFile);
    return baked;
}

Report update_report(const BakeRecord& record, const UpdateRow& row, const SolveScene& prepared,
                     const gpu::Device* device, const Stages& stages)
{
    Report report = report_of(record);
    add_facts(report, prepared, stages);
    if (device)
        add_device(report, *device);
    report.update = row;
    return report;
}

}  // namespace lumel
