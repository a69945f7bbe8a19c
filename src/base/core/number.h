#pragma once
// Parses numbers, independent of the locale.

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace lumel {

/// The finite number that `text` represents as a whole; nullopt otherwise.
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
