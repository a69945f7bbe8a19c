#pragma once
// lumel view --headless: plays a script on an interactive session.

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/solve/bake_options.h"
#include "viewer/session/session.h"

namespace lumel {

struct ScriptRun {
    std::string scene;   ///< .gltf or .glb
    std::string script;  ///< file of commands, see script.h
    std::string folder;  ///< target of its files
};

struct ViewSummary {
    int frames = 0;                  ///< with light updates
    std::vector<std::string> files;  ///< written
    double seconds = 0.0;            ///< total
    std::string report;              ///< JSON: these, and the final state
};

/// Plays the whole script, then commits its files; none if `progress` returns false before, or on
/// error. Throws Error, with "script:line" for a command that fails.
ViewSummary play_script(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress = {});

ViewSummary summary_of(const std::string& scene, ViewSession& session,
                       const std::vector<std::string>& files, double seconds);

/// Throws Error{stopped} for a script that did not end.
[[noreturn]] void throw_stopped_script();

/// View of this camera; for -1 of the first, or a generated one.
View first_view(const Scene& scene, int camera);

/// The scene with the options' lights, at the start of its animation.
Scene scene_to_view(const std::string& path, const Animation& animation,
                    const SessionOptions& options);

}  // namespace lumel
