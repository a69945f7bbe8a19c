#pragma once
// lumel view --headless: a script played on a scene that is kept lit.

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/solve/bake_options.h"
#include "viewer/session/session.h"

namespace lumel {

struct ScriptRun {
    std::string scene;   ///< .gltf or .glb
    std::string script;  ///< file of commands, see script.h
    std::string folder;  ///< of the files that it writes
};

struct ViewSummary {
    int frames = 0;                  ///< in which light followed
    std::vector<std::string> files;  ///< written
    double seconds = 0.0;            ///< in all
    std::string report;              ///< JSON: these, and the state at the end
};

/// Plays the whole script, then puts its files in place; none of them if `progress` returns false
/// before, or anything is wrong. Throws Error; of a command that cannot be done with "script:line".
ViewSummary play_script(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress = {});

/// What is to be said of a session at its end.
ViewSummary summary_of(const std::string& scene, ViewSession& session,
                       const std::vector<std::string>& files, double seconds);

/// The Error{stopped} of a script that did not come to its end.
[[noreturn]] void throw_stopped_script();

/// Of the camera of that index; of the first, or one that is chosen, for -1.
View first_view(const Scene& scene, int camera);

/// The scene with the lights of the options, as its animation begins.
Scene scene_to_view(const std::string& path, const Animation& animation,
                    const SessionOptions& options);

}  // namespace lumel
