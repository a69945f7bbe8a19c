#include "option_values.h"
#include "base/core/error.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/core.h>

#include "base/core/number.h"

namespace lumel {
namespace {

/// The whole number that the text writes in decimal digits. Nothing for 0100, which the parser of
/// options reads as the octal 64, nor for 0x10.
std::optional<std::int64_t> whole_number_of(const std::string& text)
{
    const std::size_t first_digit = text.starts_with('-') ? 1 : 0;
    if (text.size() > first_digit + 1 && text[first_digit] == '0')
        return std::nullopt;
    std::int64_t value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

}  // namespace

std::string text_of(double value)
{
    return fmt::format("{:g}", value);
}

std::string joined(const std::vector<std::string>& words, const std::string& separator)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : separator) + word;
    return text;
}

void refuse_value(const std::string& what)
{
    throw Error(ErrorKind::input, "", what);
}

std::vector<double> coordinates_of(const std::string& text)
{
    std::vector<double> numbers;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const auto number = number_of(part);
        if (!number || std::abs(*number) > kFarthest)
            return {};
        numbers.push_back(*number);
    }
    return numbers;
}

Option rectangle(std::optional<std::array<double, 4>>& target, Option option)
{
    option.type = "X0,Z0,X1,Z1";
    option.target = [&target, names = option.names](const std::string& text) {
        const std::vector<double> n = coordinates_of(text);
        if (n.size() != 4 || !(n[0] < n[2]) || !(n[1] < n[3]))
            refuse_value(fmt::format(
                "{}: '{}' is not of the form X0,Z0,X1,Z1 with X0 < X1 and Z0 < Z1", names, text));
        target = {n[0], n[1], n[2], n[3]};
    };
    return option;
}

Check whole(std::int64_t low, std::int64_t high)
{
    return [low, high](const std::string& text) -> std::string {
        const auto value = whole_number_of(text);
        if (value && *value >= low && *value <= high)
            return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
    };
}

Check positive()
{
    return [](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = double(std::strtold(text.c_str(), &end));  // as the parser reads it
        if (end == text.c_str() + text.size() && value > 0.0 && std::isfinite(value))
            return {};
        return fmt::format("'{}' is not a number above 0", text);
    };
}

Check link_rays()
{
    return [](const std::string& text) -> std::string {
        for (const char* const rays : {"4", "16", "64", "256"})
            if (text == rays)
                return {};
        return fmt::format("'{}' is none of 4, 16, 64, 256", text);
    };
}

Check even_rays()
{
    constexpr std::int64_t kMost = 3 * 4096;
    return [](const std::string& text) -> std::string {
        const std::string wrong = whole(3, kMost)(text);
        return !wrong.empty() || std::stoll(text) % 3 == 0
                   ? wrong
                   : fmt::format("'{}' is not a multiple of 3", text);
    };
}

Check between(double low, double high)
{
    return [low, high](const std::string& text) -> std::string {
        const auto value = number_of(text);
        if (value && *value >= low && *value <= high)
            return {};
        return fmt::format("'{}' is not a number from {:g} to {:g}", text, low, high);
    };
}

std::optional<std::uint64_t> bytes_of(const std::string& text)
{
    constexpr double kMebibyte = 1024.0 * 1024.0, kGibibyte = 1024.0 * kMebibyte;
    constexpr double kMax = 1024.0 * 1024.0 * kGibibyte;
    const char unit = text.empty() ? ' ' : text.back();
    if (unit != 'M' && unit != 'G')
        return {};
    const auto number = number_of(std::string_view(text).substr(0, text.size() - 1));
    const double bytes = number.value_or(0.0) * (unit == 'M' ? kMebibyte : kGibibyte);
    if (!(bytes >= 1.0 && bytes <= kMax))
        return {};
    return std::uint64_t(bytes);
}

}  // namespace lumel
