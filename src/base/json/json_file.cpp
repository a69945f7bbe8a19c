#include "base/json/json_file.h"

#include <array>
#include <charconv>

#include "base/core/files.h"
#include "base/core/number.h"

namespace lumel {

namespace {

/// indent: -1 for one line.
std::string text_of(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string json_text(const Json& json)
{
    constexpr int kIndent = 2;
    return text_of(json, kIndent);
}

void write_json(const std::string& path, const Json& json)
{
    write_text(path, json_text(json));
}

void write_compact_json(const std::string& path, const Json& json)
{
    constexpr int kOneLine = -1;
    write_text(path, text_of(json, kOneLine));
}

Json read_json(const std::string& path)
{
    const Bytes bytes = read_file(path, path);
    return parse_json(path, bytes.data(), bytes.size());
}

double shortest(float value)
{
    std::array<char, 64> digits{};
    const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    const auto number = number_of({digits.data(), std::size_t(end - digits.data())});
    return problem == std::errc() && number && float(*number) == value ? *number : double(value);
}

}  // namespace lumel
