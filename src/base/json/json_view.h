#pragma once
// A JSON value with its location in the file, so that errors of type or range are reported with it.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace lumel {

/// Preserves the order of members.
using Json = nlohmann::ordered_json;

/// One value of a document. Cheap to copy; the document must outlive it. Every reading function
/// throws Error{input} with file and JSON pointer if the value is not of the requested kind.
class JsonView {
public:
    JsonView(const std::string& file, const Json& value, std::string pointer = {})
        : file_(&file),
          value_(&value),
          pointer_(std::move(pointer))
    {
    }

    [[noreturn]] void fail(const std::string& what) const;
    /// "file: /json/pointer", as Error shows it.
    std::string place() const;
    const Json& json() const { return *value_; }

    /// Member of an object; nullopt if absent.
    std::optional<JsonView> find(const char* key) const;
    /// Required member of an object.
    JsonView get(const char* key) const;
    /// Calls visit(element, index) for each element of the array `key`, if present.
    void each(const char* key,
              const std::function<void(const JsonView&, std::size_t)>& visit) const;
    /// Every element of this array.
    void each(const std::function<void(const JsonView&, std::size_t)>& visit) const;
    /// Length of the array behind `key`, 0 if absent.
    std::size_t count(const char* key) const;
    /// Required element of this array.
    JsonView at(std::size_t index) const;
    /// extensions[name] of an object; nullopt if absent.
    std::optional<JsonView> extension(const char* name) const;

    const JsonView& as_object() const;
    const JsonView& as_array() const;
    /// An integer in low…high; 3.0 counts as one.
    std::int64_t integer(std::int64_t low, std::int64_t high) const;
    /// An index below `size` into the file's array called `array`.
    std::size_t index(std::size_t size, const char* array) const;
    /// A number that is finite as a float.
    float number() const;
    /// A finite number in low…high.
    double number(double low, double high) const;
    bool boolean() const;
    const std::string& string() const;

    float number_or(const char* key, float fallback) const;
    bool boolean_or(const char* key, bool fallback) const;
    std::string string_or(const char* key, const std::string& fallback) const;

    /// Reads `length` finite numbers from `key` into `values`. Returns false without change if
    /// absent.
    bool numbers(const char* key, float* values, std::size_t length) const;

private:
    JsonView child(const Json& value, const std::string& key) const;

    const std::string* file_;
    const Json* value_;
    std::string pointer_;
};

/// nullopt if `value` is no integer, or one that a double does not represent exactly. nlohmann's
/// own conversions are undefined for -1.0 and 1e300.
std::optional<std::int64_t> whole_number(const Json& value);

/// An index of a document that will be rewritten. Throws Json::type_error if it is invalid.
std::size_t index_of(const Json& value);

/// A string of the file for messages: in quotes, on one line, shortened.
std::string quoted(const std::string& text);

/// A value and its name in files.
template <class Value>
struct Named {
    const char* name;
    Value value;
};

/// The value that a string names; fails with all names if there is none.
template <class Value, std::size_t N>
Value named_by(const JsonView& view, const Named<Value> (&values)[N])
{
    std::string names;
    for (std::size_t i = 0; i < N; ++i) {
        if (view.string() == values[i].name)
            return values[i].value;
        names += (i == 0 ? "" : i + 1 < N ? ", " : " or ") + std::string(values[i].name);
    }
    view.fail("is " + quoted(view.string()) + ", but must be " + names);
}

/// Parses JSON text. Throws Error{input} with line and column of a mistake.
Json parse_json(const std::string& file, const std::uint8_t* text, std::size_t size);

}  // namespace lumel
