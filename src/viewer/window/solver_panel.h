#pragma once
// The panel's section for solvers: new links, and other methods.

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

/// Shows the method of the displayed light, and switches between solved light and links. Returns
/// true on a switch.
bool show_whose_light(ViewSession& session);

/// Changes take effect when a button is pressed.
void show_solvers(UiState& desk);

}  // namespace lumel
