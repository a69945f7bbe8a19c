#pragma once
// A method that solves beside the frames of the window.

#include <memory>

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

class Solving {
public:
    /// Solves the current scene. The session must outlive this, or drop() be called. Discards a
    /// running solve.
    void begin(const ViewSession& session, const SolverOptions& options);
    /// Starts and stops as the panel requests, and displays finished light. An edit of the scene
    /// ends the solve. Throws the solve's Error.
    void follow(ViewSession& session, UiState& desk);
    /// Waits until no solve is running.
    void drop() { aside_.reset(); }

private:
    void take(ViewSession& session, UiState& desk);

    std::unique_ptr<SolveAside> aside_;
};

/// Copies the solve's progress to the panel; null: no solve is running.
void note_progress(const SolveAside* solving, UiState& desk);

}  // namespace lumel
