#include "solve/solver/option_info.h"

#include <cmath>
#include <optional>

#include "base/core/number.h"

namespace lumel {
namespace {

/// "area|centre", with "|" for the separator.
std::string listed(std::span<const OptionWord> words, const char* separator)
{
    std::string list;
    for (const OptionWord& word : words)
        list += (list.empty() ? "" : separator) + std::string(word.word);
    return list;
}

/// The value that a text stands for; nothing if it is out of range.
std::optional<std::int64_t> value_of(const OptionInfo& option, const std::string& text)
{
    for (const OptionWord& word : option.words)
        if (text == word.word)
            return word.value;
    const auto number = option.is_number() ? number_of(text) : std::nullopt;
    if (!number || *number != std::floor(*number) || *number < double(option.lowest) ||
        *number > double(option.highest))
        return std::nullopt;
    return std::int64_t(*number);
}

}  // namespace

std::string OptionInfo::type() const
{
    const std::string list = listed(words, "|");
    if (!is_number())
        return list;
    return list.empty() ? unit : list + "|" + unit;
}

std::string OptionInfo::range() const
{
    if (!is_number())
        return "one of " + listed(words, ", ");
    return (words.empty() ? "" : listed(words, ", ") + " or ") + "a whole number from " +
           std::to_string(lowest) + " to " + std::to_string(highest);
}

std::string OptionInfo::get(const void* options) const
{
    const std::int64_t value = member.read(options);
    for (const OptionWord& word : words)
        if (word.value == value)
            return word.word;
    return is_number() ? std::to_string(value) : "";
}

bool OptionInfo::set(void* options, const std::string& value) const
{
    const auto found = value_of(*this, value);
    if (found)
        member.write(options, *found);
    return found.has_value();
}

}  // namespace lumel
