#pragma once
// The part of the panel that has solvers: links anew, and other methods.

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

/// Says what was solved by another method, if anything was, and changes between it and links. True
/// if it does.
bool show_whose_light(ViewSession& session);

/// Nothing of it happens before a button is pressed.
void show_solvers(UiState& desk);

}  // namespace lumel
