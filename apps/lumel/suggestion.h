#pragma once
// Words that are not known, and those that were probably meant.

#include <string>
#include <vector>

#include "command.h"

namespace lumel {

/// The one of `known` that is fewest mistakes away from `word`: letters left out, added, replaced
/// or swapped. Empty if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// The sentence for a word that is no command of the program.
std::string unknown_command(const Command& program, const std::string& word);

/// The sentence for a word that is no option of a command of the program, or of the program itself.
std::string unknown_option(const Command& program, const Command& command, const std::string& word);

}  // namespace lumel
