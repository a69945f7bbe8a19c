#pragma once
// Words that are not known, and those that were probably meant.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lumel {

/// The one of `known` that is fewest mistakes away from `word`: letters left out, added, replaced
/// or swapped. Empty if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// The sentence for a word that is no command of the program.
std::string unknown_command(const CLI::App& program, const std::string& word);

/// The sentence for a word that is no option of a command; `path` as typed: "lumel bake".
std::string unknown_option(const CLI::App& command, const std::string& path,
                           const std::string& word);

}  // namespace lumel
