#include "option_values.h"

#include <cmath>

#include "core/number.h"

namespace lumel {

CLI::Validator whole(std::int64_t low, std::int64_t high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        std::int64_t value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
            return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
    };
    return CLI::Validator(check, "");
}

CLI::Validator positive()
{
    const auto check = [](const std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value))
            return {};
        return fmt::format("'{}' is not a number above 0", text);
    };
    return CLI::Validator(check, "");
}

CLI::Validator between(double low, double high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        const auto value = number_of(text);
        if (value && *value >= low && *value <= high)
            return {};
        return fmt::format("'{}' is not a number from {:g} to {:g}", text, low, high);
    };
    return CLI::Validator(check, "");
}

std::optional<std::uint64_t> bytes_of(const std::string& text)
{
    constexpr double kMebibyte = 1024.0 * 1024.0, kGibibyte = 1024.0 * kMebibyte;
    constexpr double kMost = 1024.0 * 1024.0 * kGibibyte;
    const char unit = text.empty() ? ' ' : text.back();
    if (unit != 'M' && unit != 'G')
        return {};
    const auto number = number_of(std::string_view(text).substr(0, text.size() - 1));
    const double bytes = number.value_or(0.0) * (unit == 'M' ? kMebibyte : kGibibyte);
    if (!(bytes >= 1.0 && bytes <= kMost))
        return {};
    return std::uint64_t(bytes);
}

}  // namespace lumel
