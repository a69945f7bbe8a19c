#pragma once
// Between numpy arrays and the vectors of lumel.h.

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <lumel/lumel.h>
#include <pybind11/numpy.h>

#include "arguments.h"

namespace lumel_python {

/// A contiguous copy if the array has another type or order.
template <class T>
using Contiguous = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Throws numpy's TypeError or ValueError, with the place.
template <class Array>
Array array_of(const Argument& from)
{
    try {
        return Array(from.value);
    } catch (py::error_already_set& error) {
        rethrow_at(from.place, error);
    }
}

template <class T>
Contiguous<T> contiguous(const Argument& from)
{
    return array_of<Contiguous<T>>(from);
}

/// The array [n][Width] as rows; none if it is None. Throws ValueError for another shape.
template <std::size_t Width>
std::vector<std::array<float, Width>> rows(const Argument& from)
{
    std::vector<std::array<float, Width>> result;
    if (from.value.is_none())
        return result;
    const auto array = contiguous<float>(from);
    if (array.size() == 0)
        return result;
    if (array.ndim() != 2 || array.shape(1) != py::ssize_t(Width))
        throw py::value_error(from.place + " must have the shape (n, " + std::to_string(Width) +
                              ")");
    result.resize(std::size_t(array.shape(0)));
    std::memcpy(result.data(), array.data(), result.size() * sizeof(result[0]));
    return result;
}

/// The array [height][width][channels]. Throws ValueError for another shape.
template <class T>
Contiguous<T> image_of(const Argument& from, int channels)
{
    auto array = contiguous<T>(from);
    if (array.ndim() != 3 || array.shape(2) != channels)
        throw py::value_error(from.place + " must have the shape (height, width, " +
                              std::to_string(channels) + ")");
    return array;
}

/// Matrices of Python have their rows first, those of the library their columns.
inline lumel::Mat4 matrix_of(const Argument& from)
{
    const auto array = contiguous<float>(from);
    if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
        throw py::value_error(from.place + " must have the shape (4, 4)");
    lumel::Mat4 matrix{};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            matrix[std::size_t(4 * column + row)] = array.at(row, column);
    if (matrix[3] != 0.0f || matrix[7] != 0.0f || matrix[11] != 0.0f || matrix[15] != 1.0f)
        throw py::value_error(from.place + ": the last row must be (0, 0, 0, 1)");
    return matrix;
}

/// A view of memory that belongs to `owner`, which lives as long as the view does.
template <class T>
py::array_t<T> view_of(const T* data, const std::vector<py::ssize_t>& shape,
                       const py::handle& owner)
{
    return py::array_t<T>(shape, data, owner);
}

template <class T, std::size_t Width>
py::array_t<T> view_of(const std::vector<std::array<T, Width>>& values, const py::handle& owner)
{
    return view_of(values.empty() ? nullptr : values.front().data(),
                   {py::ssize_t(values.size()), py::ssize_t(Width)}, owner);
}

template <class T>
py::array_t<T> view_of(const std::vector<T>& values, const py::handle& owner)
{
    return view_of(values.data(), {py::ssize_t(values.size())}, owner);
}

inline py::array_t<float> view_of(const lumel::Map& map, const py::handle& owner)
{
    return view_of(map.rgba.data(), {map.height, map.width, 4}, owner);
}

/// An array that owns the map's memory.
inline py::array_t<float> array_with(lumel::Map map)
{
    auto* const kept = new lumel::Map(std::move(map));
    const py::capsule owner(kept, [](void* memory) { delete static_cast<lumel::Map*>(memory); });
    return view_of(*kept, owner);
}

/// A number for all channels, or one for each.
inline lumel::Vec3 factor_of(const py::object& factor)
{
    const auto values = contiguous<float>({factor, "factor"});
    if (values.ndim() == 0)
        return {*values.data(), *values.data(), *values.data()};
    if (values.ndim() != 1 || values.size() != 3)
        throw py::value_error("factor must be a number or 3 numbers");
    return {values.at(0), values.at(1), values.at(2)};
}

/// A getter that returns a view of a member.
template <class Object, class Member>
auto view_property(Member Object::*member)
{
    return [member](const py::object& self) {
        return view_of(self.cast<const Object&>().*member, self);
    };
}

}  // namespace lumel_python
