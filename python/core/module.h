#pragma once
// The parts of the module.

#include <pybind11/pybind11.h>

namespace lumel_python {

void add_calls(pybind11::module_& module);
void add_scene(pybind11::module_& module);
void add_daylight_maps(pybind11::module_& module);
void add_bake(pybind11::module_& module);
void add_live_scene(pybind11::module_& module);
void add_live_links(pybind11::module_& module);
void add_relight(pybind11::module_& module);

}  // namespace lumel_python
