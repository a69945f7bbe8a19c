#pragma once
// Settings given by keywords. None stands for the default. Unknown ones raise TypeError.

#include <lumel/lumel.h>
#include <pybind11/pybind11.h>

namespace lumel_python {

lumel::BakeSettings bake_settings(const pybind11::kwargs& given);
lumel::LiveSettings live_settings(const pybind11::kwargs& given);
lumel::LiveLinksSettings live_links_settings(const pybind11::kwargs& given);

}  // namespace lumel_python
