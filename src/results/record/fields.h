#pragma once
// Named fields of plain structures as members of a JSON object: one list serves reading and
// writing.

#include <cstdint>
#include <string>
#include <type_traits>

#include "base/json/json_file.h"
#include "results/record/enum_names.h"

namespace lumel {

/// Range of a field's value.
struct Limits {
    double low = 0.0, high = 1e9;
};

/// Writes fields to an object.
class FieldWriter {
public:
    explicit FieldWriter(Json& object) : object_(&object) {}

    template <class Value>
    void operator()(const char* name, const Value& value, Limits = {}) const
    {
        if constexpr (std::is_enum_v<Value>)
            (*object_)[name] = word_of(value);
        else if constexpr (std::is_same_v<Value, float>)
            (*object_)[name] = shortest(value);
        else
            (*object_)[name] = value;
    }

private:
    Json* object_;
};

/// Reads fields from an object. Throws Error{input} with file and JSON pointer for a field that is
/// missing, of another type or out of range.
class FieldReader {
public:
    explicit FieldReader(const JsonView& object) : object_(object) {}

    template <class Value>
    void operator()(const char* name, Value& value, Limits limits = {}) const
    {
        const JsonView field = object_.get(name);
        if constexpr (std::is_enum_v<Value>)
            value = value_of_word<Value>(field);
        else if constexpr (std::is_same_v<Value, bool>)
            value = field.boolean();
        else if constexpr (std::is_same_v<Value, std::string>)
            value = field.string();
        else if constexpr (std::is_integral_v<Value>)
            value = Value(field.integer(std::int64_t(limits.low), std::int64_t(limits.high)));
        else
            value = Value(field.number(limits.low, limits.high));
    }

private:
    JsonView object_;
};

}  // namespace lumel
