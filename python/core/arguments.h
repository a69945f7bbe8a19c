#pragma once
// Arguments from Python, with their places for the messages of errors.

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace lumel_python {

namespace py = pybind11;

/// A value and its place, "meshes[2].primitives[0].material", which errors name.
struct Argument {
    py::object value;
    std::string place;

    /// Throws TypeError if there is no such attribute.
    Argument operator[](const char* attribute) const;
};

/// Throws TypeError: the argument must be `expected`, not what it is.
[[noreturn]] void refuse_type(const Argument& from, const std::string& expected);
/// Rethrows `error`, which is being handled; if it is a TypeError or ValueError, with the place
/// before its message.
[[noreturn]] void rethrow_at(const std::string& place, py::error_already_set& error);

template <class T>
[[noreturn]] void refuse_range(const Argument& from)
{
    using Limits = std::numeric_limits<T>;
    throw py::value_error(from.place + " must lie between " + std::to_string(Limits::min()) +
                          " and " + std::to_string(Limits::max()));
}

/// Throws TypeError, and ValueError for an integer out of range.
template <class T>
T value_of(const Argument& from)
{
    try {
        return from.value.cast<T>();
    } catch (const py::cast_error&) {
        constexpr bool is_bool = std::is_same_v<T, bool>;
        if constexpr (std::is_integral_v<T> && !is_bool)
            if (PyIndex_Check(from.value.ptr()))
                refuse_range<T>(from);
        if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
            refuse_type(from, is_bool                       ? "True or False"
                              : std::is_integral_v<T>       ? "an integer"
                              : std::is_floating_point_v<T> ? "a number"
                                                            : "a string");
        else
            throw py::type_error(from.place + " must be " + std::to_string(std::tuple_size_v<T>) +
                                 " numbers");
    }
}

template <class T>
void read(const Argument& from, T& to)
{
    to = value_of<T>(from);
}

template <class T>
void read(const Argument& from, std::optional<T>& to)
{
    to = value_of<T>(from);
}

/// All elements, by `make`. Throws TypeError if the argument has none.
template <class T>
std::vector<T> all_of(const Argument& from, T (*make)(const Argument&))
{
    if (!py::isinstance<py::iterable>(from.value))
        refuse_type(from, "a sequence");
    std::vector<T> result;
    for (const py::handle one : from.value)
        result.push_back(make({py::reinterpret_borrow<py::object>(one),
                               from.place + "[" + std::to_string(result.size()) + "]"}));
    return result;
}

/// The value of a word. Throws ValueError with the valid words.
template <class Value>
Value word_of(const Argument& from, std::initializer_list<std::pair<const char*, Value>> words)
{
    const auto given = value_of<std::string>(from);
    std::string all;
    for (const auto& [word, value] : words) {
        if (given == word)
            return value;
        all += (all.empty() ? "\"" : ", \"") + std::string(word) + "\"";
    }
    throw py::value_error(from.place + " must be one of " + all);
}

/// The path of a str or an os.PathLike.
std::string path_of(const Argument& from);
inline std::string path_of(const py::object& path)
{
    return path_of(Argument{path, "path"});
}

}  // namespace lumel_python
