#pragma once
// Parses a method and its options from words.

#include <span>
#include <string>

#include "methods/methods.h"

namespace lumel {

/// "progressive", "--batch", "4", "--error", "1": a method, then its options and limits as on the
/// command line. Throws Error{input} with `place`, the location of the words.
SolverOptions solve_order(std::span<const std::string> words, const std::string& place);

}  // namespace lumel
