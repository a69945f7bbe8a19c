#pragma once
// Options of the command line as fields of methods' structs: words and whole numbers.

#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

#include "base/core/number.h"
#include "methods/methods.h"

namespace lumel::option_tables {

/// A value that is a word.
template <class Value>
struct Word {
    const char* word;
    Value value;
};

/// The name and help of an option, and when it counts.
struct Label {
    const char* name;
    const char* type;
    const char* help;
    const char* with = nullptr;
    const char* with_value = nullptr;
};

/// An option that takes one of a few words.
template <class Options, const auto& words, auto field>
constexpr OptionInfo choice(const Label& label)
{
    return {.name = label.name,
            .type = label.type,
            .help = label.help,
            .with = label.with,
            .with_value = label.with_value,
            .is_number = false,
            .range =
                [] {
                    std::string list;
                    for (const auto& [word, value] : words)
                        list += (list.empty() ? "" : ", ") + std::string(word);
                    return "one of " + list;
                },
            .get =
                [](const MethodOptions& method) {
                    std::string found;
                    for (const auto& [word, value] : words)
                        if (field(std::get<Options>(method)) == value)
                            found = word;
                    return found;
                },
            .set =
                [](MethodOptions& method, const std::string& text) {
                    for (const auto& [word, value] : words)
                        if (text == word) {
                            field(std::get<Options>(method)) = value;
                            return true;
                        }
                    return false;
                }};
}

/// The word that stands for 0, where 0 is no number of its own.
enum class Zero { number, automatic, all };

constexpr const char* word_of(Zero zero)
{
    return zero == Zero::automatic ? "auto" : zero == Zero::all ? "all" : "";
}

/// An option that takes a whole number.
template <class Options, auto low, auto high, auto field, Zero zero = Zero::number>
constexpr OptionInfo number(const Label& label)
{
    return {.name = label.name,
            .type = label.type,
            .help = label.help,
            .with = label.with,
            .with_value = label.with_value,
            .is_number = true,
            .range =
                [] {
                    return (zero == Zero::number ? "" : word_of(zero) + std::string(" or ")) +
                           "a whole number from " + std::to_string(low) + " to " +
                           std::to_string(high);
                },
            .get =
                [](const MethodOptions& method) {
                    const auto value = field(std::get<Options>(method));
                    return zero != Zero::number && value == 0 ? word_of(zero)
                                                              : std::to_string(value);
                },
            .set =
                [](MethodOptions& method, const std::string& text) {
                    auto& value = field(std::get<Options>(method));
                    using Value = std::decay_t<decltype(value)>;
                    if (zero != Zero::number && text == word_of(zero)) {
                        value = 0;
                        return true;
                    }
                    const auto found = number_of(text);
                    if (!found || *found != std::floor(*found) || *found < double(low) ||
                        *found > double(high))
                        return false;
                    value = Value(*found);
                    return true;
                }};
}

}  // namespace lumel::option_tables
