#pragma once
// A script played on a session, a frame of light at a time.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "results/files/folder.h"
#include "viewer/session/script.h"
#include "viewer/session/session.h"

namespace lumel {

/// Does what a script says.
class ScriptPlayer {
public:
    /// script: read from `path`. folder: that `output` is of. window: what it shows; empty: there
    /// is none. What is given must outlive it.
    ScriptPlayer(std::vector<ScriptCommand> script, std::string path, ViewSession& session,
                 OutputFolder& output, std::string folder, std::function<Image()> window = {});

    bool done() const { return next_ == script_.size(); }
    const SolveAside* solving() const { return solving_.get(); }  ///< null: nothing is solved now
    /// What is being solved ends with the light that there is then; without any, the script goes
    /// on.
    void stop_solving();
    bool has_quit() const { return quit_; }  ///< by its own word
    /// Does what stands before the next frame of light, and lets light follow for it; or all that
    /// is left. While a method solves, it is a step to wait a moment for it. Throws Error; of a
    /// command that cannot be done with "script:line".
    void step();
    const std::vector<std::string>& files() const { return files_; }  ///< written

private:
    bool play(const ScriptCommand& command);
    bool solve(const ScriptCommand& command);
    bool write(const ScriptCommand& command);
    void look(const ScriptCommand& command);
    void handle(const ScriptCommand& command);
    void light(const ScriptCommand& command);
    void show(const ScriptCommand& command);

    std::vector<ScriptCommand> script_;
    std::string path_;
    ViewSession* session_;
    OutputFolder* output_;
    std::string folder_;
    std::function<Image()> window_;
    std::size_t next_ = 0;
    int frames_ = 0;  ///< of the command that is being done
    std::unique_ptr<SolveAside> solving_;
    bool quit_ = false;
    std::vector<std::string> files_;
};

/// Reads a script's file. Throws Error{input}.
std::vector<ScriptCommand> script_of(const std::string& path);

}  // namespace lumel
