#pragma once
// Numbers written in text, whatever the user's language.

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace lumel {

/// The finite number that the whole text represents; nothing if it is not one.
inline std::optional<double> number_of(std::string_view text)
{
    if (text.starts_with('+'))
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace lumel
