#include "suggestion.h"

#include <algorithm>

#include <fmt/core.h>

#include "listing.h"

namespace lumel {
namespace {

/// Edits that turn one word into the other: the optimal string alignment distance.
std::size_t mistakes(const std::string& a, const std::string& b)
{
    const std::size_t width = b.size() + 1;
    std::vector<std::size_t> cost((a.size() + 1) * width);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
        return cost[i * width + j];
    };
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = i + j;
                continue;
            }
            const std::size_t replaced = a[i - 1] == b[j - 1] ? 0 : 1;
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return cost.back();
}

/// "; did you mean X?", or else where the words are listed.
std::string advice(const std::string& word, const std::vector<std::string>& known,
                   const std::string& path)
{
    const std::string meant = nearest_word(word, known);
    return meant.empty() ? fmt::format("; see {} --help", path)
                         : fmt::format("; did you mean {}?", meant);
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known)
{
    constexpr std::size_t kLettersPerMistake = 3;  // in more mistakes than that no word is left
    std::string nearest;
    std::size_t fewest = word.size() / kLettersPerMistake + 1;
    for (const std::string& candidate : known)
        if (const std::size_t count = mistakes(word, candidate); count < fewest) {
            fewest = count;
            nearest = candidate;
        }
    return nearest;
}

std::string unknown_command(const Command& program, const std::string& word)
{
    std::vector<std::string> names;
    for (const Command* command : commands_of(program))
        names.push_back(command->name);
    return fmt::format("{} is not a command of {}{}", word, program.name,
                       advice(word, names, program.name));
}

std::string unknown_option(const Command& program, const Command& command, const std::string& word)
{
    const std::string path = path_of(program, command);
    std::vector<std::string> names;
    for (const Option* option : options_of(command))
        for (const std::string& name : names_of(*option))
            names.push_back(name);
    return fmt::format("{} is not an option of {}{}", word, path,
                       advice(word.substr(0, word.find('=')), names, path));
}

}  // namespace lumel
