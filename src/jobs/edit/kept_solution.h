#pragma once
// Bakes with links stored for later runs.

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

/// Lights a scene over stored links as their bake did, to the same target error.
class KeptSolution {
public:
    /// Scene and links must outlive this.
    KeptSolution(const SolveScene& scene, const BakeRecord& baked, const StoredLinks& links,
                 LinkRadiosity::Then then);

    /// Solves for the present lamps, emission and sky of the scene.
    void light(const ProgressCallback& progress);
    LinkRadiosity& solver() { return solver_; }

private:
    const SolverOptions options_;
    LinkRadiosity solver_;
};

}  // namespace lumel
