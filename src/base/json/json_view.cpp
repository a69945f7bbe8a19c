#include "base/json/json_view.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"

namespace lumel {

namespace {

/// A member's name as a JSON pointer token (RFC 6901).
std::string escaped(const std::string& key)
{
    std::string token;
    for (char c : key)
        token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return token;
}

}  // namespace

std::string JsonView::place() const
{
    return pointer_.empty() ? *file_ : *file_ + ": " + pointer_;
}

void JsonView::fail(const std::string& what) const
{
    throw Error(ErrorKind::input, place(), what);
}

JsonView JsonView::child(const Json& value, const std::string& key) const
{
    return {*file_, value, pointer_ + "/" + key};
}

std::optional<JsonView> JsonView::find(const char* key) const
{
    as_object();
    const auto member = value_->find(key);
    if (member == value_->end())
        return std::nullopt;
    return child(*member, escaped(key));
}

JsonView JsonView::get(const char* key) const
{
    if (auto member = find(key))
        return *member;
    fail(std::string("\"") + key + "\" is missing");
}

void JsonView::each(const char* key,
                    const std::function<void(const JsonView&, std::size_t)>& visit) const
{
    if (const auto array = find(key))
        array->each(visit);
}

void JsonView::each(const std::function<void(const JsonView&, std::size_t)>& visit) const
{
    as_array();
    for (std::size_t i = 0; i < value_->size(); ++i)
        visit(child((*value_)[i], std::to_string(i)), i);
}

std::size_t JsonView::count(const char* key) const
{
    const auto array = find(key);
    return array ? array->as_array().json().size() : 0;
}

JsonView JsonView::at(std::size_t index) const
{
    as_array();
    if (index >= value_->size())
        fail("has " + std::to_string(value_->size()) + " elements, but element " +
             std::to_string(index) + " is needed");
    return child((*value_)[index], std::to_string(index));
}

std::optional<JsonView> JsonView::extension(const char* name) const
{
    const auto extensions = find("extensions");
    if (!extensions)
        return std::nullopt;
    const auto found = extensions->find(name);
    if (found)
        found->as_object();
    return found;
}

const JsonView& JsonView::as_object() const
{
    if (!value_->is_object())
        fail("must be a JSON object");
    return *this;
}

const JsonView& JsonView::as_array() const
{
    if (!value_->is_array())
        fail("must be a JSON array");
    return *this;
}

std::int64_t JsonView::integer(std::int64_t low, std::int64_t high) const
{
    const std::optional<std::int64_t> whole = whole_number(*value_);
    if (!whole)
        fail("must be a whole number");
    if (*whole < low || *whole > high)
        fail("is " + std::to_string(*whole) + ", but must lie in " + std::to_string(low) + " to " +
             std::to_string(high));
    return *whole;
}

std::size_t JsonView::index(std::size_t size, const char* array) const
{
    const std::int64_t value = integer(INT64_MIN, INT64_MAX);
    if (value < 0 || static_cast<std::uint64_t>(value) >= size)
        fail("refers to " + std::string(array) + "[" + std::to_string(value) +
             "], but the file has " + std::to_string(size) + " " + array);
    return static_cast<std::size_t>(value);
}

std::optional<std::int64_t> whole_number(const Json& value)
{
    constexpr double kLargestExact = 9007199254740992.0;  // 2^53, larger than any size in a file
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(std::abs(number) <= kLargestExact) || number != std::floor(number))
        return std::nullopt;
    return static_cast<std::int64_t>(number);
}

std::size_t index_of(const Json& value)
{
    const std::optional<std::int64_t> whole = whole_number(value);
    if (!whole || *whole < 0)
        throw Json::type_error::create(302, "an index must be a whole number", &value);
    return static_cast<std::size_t>(*whole);
}

float JsonView::number() const
{
    if (!value_->is_number())
        fail("must be a number");
    const auto value = static_cast<float>(value_->get<double>());
    if (!std::isfinite(value))
        fail("is too large a number");
    return value;
}

double JsonView::number(double low, double high) const
{
    const double value = value_->is_number() ? value_->get<double>() : std::nan("");
    if (!std::isfinite(value))
        fail("must be a number");
    if (value < low || value > high)
        fail("is " + value_->dump() + ", but must lie in " + Json(low).dump() + " to " +
             Json(high).dump());
    return value;
}

bool JsonView::boolean() const
{
    if (!value_->is_boolean())
        fail("must be true or false");
    return value_->get<bool>();
}

const std::string& JsonView::string() const
{
    if (!value_->is_string())
        fail("must be a string");
    return value_->get_ref<const std::string&>();
}

float JsonView::number_or(const char* key, float fallback) const
{
    const auto member = find(key);
    return member ? member->number() : fallback;
}

bool JsonView::boolean_or(const char* key, bool fallback) const
{
    const auto member = find(key);
    return member ? member->boolean() : fallback;
}

std::string JsonView::string_or(const char* key, const std::string& fallback) const
{
    const auto member = find(key);
    return member ? member->string() : fallback;
}

bool JsonView::numbers(const char* key, float* values, std::size_t length) const
{
    const auto array = find(key);
    if (!array)
        return false;
    if (array->as_array().json().size() != length)
        array->fail("must hold " + std::to_string(length) + " numbers, not " +
                    std::to_string(array->json().size()));
    array->each([&](const JsonView& element, std::size_t i) { values[i] = element.number(); });
    return true;
}

std::string quoted(const std::string& text)
{
    constexpr std::size_t kLongest = 120;
    constexpr unsigned char kContinuation = 0x80;  // UTF-8 bytes 10xxxxxx do not start a character
    std::size_t length = std::min(text.size(), kLongest);
    while (length > 0 && length < text.size() &&
           (static_cast<unsigned char>(text[length]) & 0xC0) == kContinuation)
        --length;
    std::string shown = text.substr(0, length);
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < ' ' || c == 0x7F)
            c = '?';
    return "\"" + shown + (length < text.size() ? "…" : "") + "\"";
}

Json parse_json(const std::string& file, const std::uint8_t* text, std::size_t size)
{
    // Functions that traverse a document recurse for each level.
    constexpr int kDeepest = 200;
    const auto check_depth = [&](int depth, Json::parse_event_t, const Json&) {
        if (depth > kDeepest)
            throw Error(ErrorKind::input, file,
                        "its JSON is nested more than " + std::to_string(kDeepest) + " deep");
        return true;
    };
    try {
        return Json::parse(text, text + size, check_depth);
    } catch (const Json::parse_error& error) {
        const std::size_t stop = std::min(size, error.byte > 0 ? error.byte - 1 : 0);
        const auto line = 1 + std::count(text, text + stop, '\n');
        const std::uint8_t* line_start = text + stop;
        while (line_start > text && line_start[-1] != '\n')
            --line_start;
        throw Error(ErrorKind::input, file,
                    "its JSON is broken at line " + std::to_string(line) + ", column " +
                        std::to_string(text + stop - line_start + 1));
    } catch (const Json::exception&) {
        throw Error(ErrorKind::input, file, "its JSON holds a number that is too large");
    }
}

}  // namespace lumel
