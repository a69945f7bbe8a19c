#pragma once
// A session saved as a bake.

#include <string>

#include "jobs/solve/bake_options.h"
#include "viewer/session/session.h"

namespace lumel {

/// Writes the scene as it stands now as one .glb file: things where they were moved to, without
/// those that were deleted, dimmed and painted; standing still. Throws Error{input} for what a file
/// cannot hold.
void write_scene_as_it_stands(const ViewSession& session, const std::string& path);

/// The lights of the options as they are now. Throws Error{input} for what options cannot say.
LightOptions lights_as_they_are(const ViewSession& session);

/// Bakes the scene as it stands into a folder, at the session's resolution, with all files of
/// `lumel bake`.
BakeSummary save_bake(const ViewSession& session, const std::string& folder,
                      const ProgressFunction& progress = {});

}  // namespace lumel
