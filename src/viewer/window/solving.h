#pragma once
// A method that solves beside the frames of the window.

#include <memory>

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

class Solving {
public:
    /// Of the scene as it stands now. The session must outlive it, or drop() be called. What was
    /// solved before ends without light.
    void begin(const ViewSession& session, const SolverOptions& options);
    /// Begins and stops what the panel asks for, and shows light that is there. A scene that was
    /// changed meanwhile ends it. Throws Error of what could not be solved.
    void follow(ViewSession& session, UiState& desk);
    /// Waits until nothing is solved any more.
    void drop() { aside_.reset(); }

private:
    void take(ViewSession& session, UiState& desk);

    std::unique_ptr<SolveAside> aside_;
};

/// Writes down for the panel how far it is; nothing is solved if it is null.
void note_progress(const SolveAside* solving, UiState& desk);

}  // namespace lumel
