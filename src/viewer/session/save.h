#pragma once
// Saves a session as a bake.

#include <string>

#include "jobs/solve/bake_options.h"
#include "viewer/session/session.h"

namespace lumel {

/// Writes the current scene as one .glb file: moved, deleted, dimmed and recoloured objects as they
/// are, without animation. Throws Error{input} for edits that a file cannot express.
void write_scene_as_it_stands(const ViewSession& session, const std::string& path);

/// The options' lights in their current state. Throws Error{input} for edits that options cannot
/// express.
LightOptions lights_as_they_are(const ViewSession& session);

/// Bakes the current scene into a folder, at the session's resolution, with all files of `lumel
/// bake`.
BakeSummary save_bake(const ViewSession& session, const std::string& folder,
                      const ProgressFunction& progress = {});

}  // namespace lumel
