// A baked scene under other light.

#include <optional>

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "calls.h"
#include "module.h"

namespace lumel_python {
namespace {

using lumel::Relight;

Relight of_bake(const lumel::Device& device, const lumel::Baked& baked)
{
    return result_of<Relight>([&] { return Relight(device, baked); });
}

Relight of_file(const lumel::Device& device, const py::object& path)
{
    const std::string file = path_of(path);
    return result_of<Relight>([&] { return Relight(device, file); });
}

void set_light(Relight& relight, const std::string& name, const py::object& factor)
{
    const lumel::Vec3 by = factor_of(factor);
    call([&] { relight.set_light(name, by); });
}

void move_light(Relight& relight, const std::string& name,
                const std::optional<lumel::Vec3>& position,
                const std::optional<lumel::Vec3>& direction)
{
    call([&] { relight.move_light(name, {position, direction}); });
}

void save(const Relight& relight, const py::object& path)
{
    const std::string file = path_of(path);
    call([&] { relight.save(file); });
}

}  // namespace

void add_relight(py::module_& module)
{
    py::class_<Relight, Held<Relight>>(module, "Relight", "A baked scene under any light.")
        .def(py::init(&of_bake), "Of a bake with method \"matrix\".", py::arg("device"),
             py::arg("baked"), py::keep_alive<1, 2>())
        .def(py::init(&of_file), "Of a file scene.lumelmat.", py::arg("device"), py::arg("path"),
             py::keep_alive<1, 2>())
        .def_property_readonly(
            "lights",
            [](const Relight& relight) {
                return result_of<std::vector<std::string>>([&] { return relight.lights(); });
            },
            "Names of the sources.")
        .def("set_light", &set_light, "Scales a source, or the emission of a material.",
             py::arg("name"), py::arg("factor"))
        .def("move_light", &move_light, "Moves or turns a lamp.", py::arg("name"), py::kw_only(),
             py::arg("position") = py::none(), py::arg("direction") = py::none())
        .def(
            "map",
            [](Relight& relight) {
                return array_with(result_of<lumel::Map>([&] { return relight.map(); }));
            },
            "(height, width, 4), as Baked.map; a new array.")
        .def("save", &save, "Writes scene.lumelmat.", py::arg("path"));
}

}  // namespace lumel_python
