// The module lumel._core; lumel/_core.pyi has its types and full docstrings.

#include <string>

#include <lumel/lumel.h>
#include <pybind11/pybind11.h>

#include "module.h"

PYBIND11_MODULE(_core, module)
{
    const int version = lumel::version();
    module.attr("__version__") = std::to_string(version / 10'000) + "." +
                                 std::to_string(version / 100 % 100) + "." +
                                 std::to_string(version % 100);
    lumel_python::add_calls(module);
    lumel_python::add_scene(module);
    lumel_python::add_daylight_maps(module);
    lumel_python::add_bake(module);
    lumel_python::add_live_scene(module);
    lumel_python::add_live_links(module);
    lumel_python::add_relight(module);
}
