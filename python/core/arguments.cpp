#include "arguments.h"

namespace lumel_python {

Argument Argument::operator[](const char* attribute) const
{
    if (!py::hasattr(value, attribute))
        throw py::type_error(place + " has no attribute \"" + attribute + "\"");
    return {value.attr(attribute), place + "." + attribute};
}

void refuse_type(const Argument& from, const std::string& expected)
{
    throw py::type_error(from.place + " must be " + expected + ", not " +
                         std::string(py::str(py::type::of(from.value).attr("__name__"))));
}

void rethrow_at(const std::string& place, py::error_already_set& error)
{
    const bool is_type_error = error.matches(PyExc_TypeError);
    if (!is_type_error && !error.matches(PyExc_ValueError))
        throw;
    const std::string message = place + ": " + std::string(py::str(error.value()));
    py::raise_from(error, is_type_error ? PyExc_TypeError : PyExc_ValueError, message.c_str());
    throw py::error_already_set();
}

std::string path_of(const Argument& from)
{
    try {
        return value_of<std::string>(
            {py::module_::import("os").attr("fspath")(from.value), from.place});
    } catch (py::error_already_set& error) {
        rethrow_at(from.place, error);
    }
}

}  // namespace lumel_python
