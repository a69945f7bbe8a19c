#pragma once
// Kinds of values that options take.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.h"

namespace lumel {

/// Accepts whole numbers from `low` to `high`.
Check whole(std::int64_t low, std::int64_t high);

/// Accepts positive finite numbers.
Check positive();

/// Accepts the numbers of rays per lumel of live links: 4, 16, 64 and 256.
Check link_rays();
/// Accepts numbers of rays that three solutions share evenly.
Check even_rays();

/// Accepts finite numbers from `low` to `high`.
Check between(double low, double high);

/// Coordinates that floats still resolve to a decimetre [m].
inline constexpr double kFarthest = 1e6;

/// Throws Error{input}.
[[noreturn]] void refuse_value(const std::string& what);

/// The numbers of "X,Y,Z"; empty if one is none, or is beyond kFarthest.
std::vector<double> coordinates_of(const std::string& text);

/// The option with what it needs to take a rectangle: type and target. target: X0, Z0, X1 and Z1;
/// must outlive the command.
Option rectangle(std::optional<std::array<double, 4>>& target, Option option);

/// The bytes of "512M", "2G" or "1.5G"; nothing for what is no such size.
std::optional<std::uint64_t> bytes_of(const std::string& text);

/// A number as --help prints it: 0.5, 1e-06.
std::string text_of(double value);
inline std::string text_of(std::integral auto value)
{
    return std::to_string(value);
}

/// "a, b, c", with ", " for the separator.
std::string joined(const std::vector<std::string>& words, const std::string& separator);

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// The option with the rest of what it needs to take one of a few words: type, default, target and
/// check. `value` and `choices` must outlive the command.
template <class Value>
Option choice(Value& value, const Choices<Value>& choices, Option option)
{
    std::vector<std::string> words;
    std::string standard;
    for (const auto& [word, meaning] : choices) {
        words.push_back(word);
        if (meaning == value)
            standard = word;
    }
    option.type = joined(words, "|");
    if (option.default_value.empty() && !option.required)
        option.default_value = standard;
    option.target = [&value, &choices](const std::string& given) {
        for (const auto& [word, meaning] : choices)
            if (word == given)
                value = meaning;
    };
    option.check = [words](const std::string& given) -> std::string {
        if (std::find(words.begin(), words.end(), given) != words.end())
            return {};
        return "'" + given + "' is none of " + joined(words, ", ");
    };
    return option;
}

}  // namespace lumel
