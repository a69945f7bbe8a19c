#pragma once
// Plays a script on a session, frame by frame.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "results/files/folder.h"
#include "viewer/session/script.h"
#include "viewer/session/session.h"

namespace lumel {

/// Executes the commands of a script.
class ScriptPlayer {
public:
    /// script: read from `path`. folder: target of `output`. window: returns the window's image;
    /// empty: no window, and the script asks for none. All arguments must outlive this.
    ScriptPlayer(std::vector<ScriptCommand> script, std::string path, ViewSession& session,
                 OutputFolder& output, std::string folder, std::function<Image()> window = {});

    bool done() const { return next_ == script_.size(); }
    const SolveAside* solving() const { return solving_.get(); }  ///< null: no solve is running
    /// Ends the running solve with its current light; without any, the script continues.
    void stop_solving();
    bool has_quit() const { return quit_; }  ///< by the command
    /// Executes the commands before the next frame of light, and that frame; or all remaining ones.
    /// While a method solves, a step waits briefly for it. Throws Error, with "script:line" for a
    /// command that fails.
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
    int frames_ = 0;  ///< done, of the current command
    std::unique_ptr<SolveAside> solving_;
    bool quit_ = false;
    std::vector<std::string> files_;
};

/// Reads a script file. Throws Error{input}.
std::vector<ScriptCommand> script_of(const std::string& path);

}  // namespace lumel
