#pragma once
// Ctrl-C as a wish to finish early.

namespace lumel {

/// From now on the first Ctrl-C (or SIGTERM) only sets a flag; one that comes later than half a
/// second after it ends the program.
void watch_interrupts();

/// True once the user has pressed Ctrl-C.
bool interrupted();

/// 128 + the signal's number, as shells report it: 130 for Ctrl-C.
int interrupt_exit_code();

}  // namespace lumel
