// Light of a changing scene by shooting on a GPU.

#include <limits>

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "calls.h"
#include "live.h"
#include "module.h"
#include "settings.h"

namespace lumel_python {
namespace {

using lumel::LiveScene;
using lumel::LiveState;

LiveScene make(const lumel::Device& device, const lumel::Scene& scene, const py::kwargs& given)
{
    const lumel::LiveSettings settings = live_settings(given);
    return result_of<LiveScene>([&] { return LiveScene(device, scene, settings); });
}

void move(LiveScene& live, std::uint32_t instance, const py::object& transform)
{
    const lumel::Mat4 matrix = matrix_of({transform, "transform"});
    call([&] { live.move(instance, matrix); });
}

using Scale = void (LiveScene::*)(std::uint32_t, const lumel::Vec3&);

template <Scale scale>
void set_factor(LiveScene& live, std::uint32_t index, const py::object& factor)
{
    const lumel::Vec3 by = factor_of(factor);
    call([&] { (live.*scale)(index, by); });
}

void set_sky(LiveScene& live, const py::object& factor)
{
    const lumel::Vec3 by = factor_of(factor);
    call([&] { live.set_sky(by); });
}

void add_state(py::module_& module)
{
    py::class_<LiveState>(module, "LiveState", "Status of a LiveScene.")
        .def_readonly("residual", &LiveState::residual)
        .def_readonly("under_way", &LiveState::under_way)
        .def_readonly("at_rest", &LiveState::at_rest)
        .def_readonly("milliseconds", &LiveState::milliseconds);
}

}  // namespace

void add_live_scene(py::module_& module)
{
    add_state(module);
    py::class_<LiveScene, Held<LiveScene>>(module, "LiveScene",
                                           "Keeps a scene lit while it changes, on a GPU.")
        .def(py::init(&make), "Builds the atlas; settings as in lumel.h.", py::arg("device"),
             py::arg("scene"), py::keep_alive<1, 2>())
        .def("move", &move, "(4, 4), mesh to world, a rigid motion; update() applies it.",
             py::arg("instance"), py::arg("transform"))
        .def("set_emission", &set_factor<&LiveScene::set_emission>,
             "Scales the emission of an instance.", py::arg("instance"), py::arg("factor"))
        .def("set_reflectance", &set_factor<&LiveScene::set_reflectance>,
             "Scales the reflectance of an instance.", py::arg("instance"), py::arg("factor"))
        .def("set_light", &set_factor<&LiveScene::set_light>,
             "Scales a light, an index into Scene.lights.", py::arg("light"), py::arg("factor"))
        .def("set_sky", &set_sky, "Scales the sky, relative to the scene.", py::arg("factor"))
        .def("update", &update_in_slices<LiveScene, LiveState>,
             "Runs for about this time, by default until converged.",
             py::arg("budget_ms") = std::numeric_limits<double>::infinity())
        .def_property_readonly(
            "state",
            [](const LiveScene& live) {
                return result_of<LiveState>([&] { return live.state(); });
            },
            "After the last update().")
        .def(
            "map",
            [](const LiveScene& live) {
                return array_with(result_of<lumel::Map>([&] { return live.map(); }));
            },
            "(height, width, 4), as Baked.map; a new array.")
        .def_property_readonly("surfaces", &LiveScene::surfaces)
        .def_property_readonly(
            "notes", [](const LiveScene& live) { return in_python(live.notes()); },
            "Messages for the user.");
}

}  // namespace lumel_python
