#pragma once
// Bakes with links stored for later runs.

#include <memory>

#include "jobs/edit/edited_scene.h"
#include "jobs/solve/bake_options.h"
#include "links/trace/links.h"

namespace lumel {

/// Throws Error{input} if the bake has no links to keep.
void check_keep_links(const BakeOptions& options);

/// Throws Error{input} unless the links, of file `path`, are those of the bake.
void check_links(const StoredLinks& links, const BakeRecord& baked, const std::string& path);

/// Stored links renumbered for the scene after an edit.
StoredLinks links_for(const EditedScene& edit, const StoredLinks& before);

/// Light of a scene over stored links, found as that of their bake, to the same target error. All
/// arguments but the progress must outlive the result.
std::unique_ptr<LinkRadiosity> lit_over_links(const SolveScene& scene, const BakeRecord& baked,
                                              const StoredLinks& links, LinkRadiosity::Then then,
                                              const ProgressCallback& progress);

}  // namespace lumel
