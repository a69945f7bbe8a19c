#pragma once
// Kinds of values that options take.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace lumel {

/// Accepts whole numbers from `low` to `high`.
CLI::Validator whole(std::int64_t low, std::int64_t high);

/// Accepts positive finite numbers.
CLI::Validator positive();

/// Accepts the numbers of rays that lumels can keep as links: 4, 16, 64 and 256.
CLI::Validator link_rays();

/// Accepts finite numbers from `low` to `high`.
CLI::Validator between(double low, double high);

/// Coordinates that floats still resolve to a decimetre [m].
inline constexpr double kFarthest = 1e6;

/// The numbers of "X,Y,Z"; empty if one is none, or is beyond kFarthest.
std::vector<double> coordinates_of(const std::string& text);

/// The bytes of "512M", "2G" or "1.5G"; nothing for what is no such size.
std::optional<std::uint64_t> bytes_of(const std::string& text);

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// An option that takes one of a few words. `value` and `choices` must outlive the parser.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const Choices<Value>& choices, const std::string& help)
{
    const auto assign = [&value, &choices](const std::string& word) {
        for (const auto& [choice, meaning] : choices)
            if (choice == word)
                value = meaning;
    };
    std::vector<std::string> words;
    std::string standard;
    for (const auto& [choice, meaning] : choices) {
        words.push_back(choice);
        if (meaning == value)
            standard = choice;
    }
    return app.add_option_function<std::string>(name, assign, help)
        ->type_name(CLI::detail::join(words, "|"))
        ->default_str(standard)
        ->check([words](const std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return {};
            return fmt::format("'{}' is none of {}", word, CLI::detail::join(words, ", "));
        });
}

}  // namespace lumel
