// Light that is kept up to date while objects and lamps move.

#include <limits>
#include <optional>

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "calls.h"
#include "live.h"
#include "module.h"
#include "settings.h"

namespace lumel_python {
namespace {

using lumel::LiveLinks;
using lumel::LiveLinksState;

LiveLinks make(const lumel::Scene& scene, const py::kwargs& given)
{
    const lumel::LiveLinksSettings settings = live_links_settings(given);
    return result_of<LiveLinks>([&] { return LiveLinks(scene, settings); });
}

void move(LiveLinks& live, std::uint32_t instance, const py::object& transform)
{
    const lumel::Mat4 matrix = matrix_of({transform, "transform"});
    call([&] { live.move(instance, matrix); });
}

void move_lamp(LiveLinks& live, const std::string& name, const std::optional<lumel::Vec3>& position,
               const std::optional<lumel::Vec3>& direction)
{
    call([&] { live.move_lamp(name, {position, direction}); });
}

void set_lamp(LiveLinks& live, const std::string& name, const py::object& factor)
{
    const lumel::Vec3 by = factor_of(factor);
    call([&] { live.set_lamp(name, by); });
}

void set_sky(LiveLinks& live, const py::object& factor)
{
    const lumel::Vec3 by = factor_of(factor);
    call([&] { live.set_sky(by); });
}

void set_color(LiveLinks& live, const std::string& material, const lumel::Vec3& color)
{
    call([&] { live.set_color(material, color); });
}

double bake(LiveLinks& live, double error)
{
    return result_of<double>([&] { return live.bake(error); });
}

void add_state(py::module_& module)
{
    py::class_<LiveLinksState>(module, "LiveLinksState", "Status of LiveLinks.")
        .def_readonly("residual", &LiveLinksState::residual)
        .def_readonly("dark_residual", &LiveLinksState::dark_residual)
        .def_readonly("under_way", &LiveLinksState::under_way)
        .def_readonly("at_rest", &LiveLinksState::at_rest)
        .def_readonly("milliseconds", &LiveLinksState::milliseconds);
}

}  // namespace

void add_live_links(py::module_& module)
{
    add_state(module);
    py::class_<LiveLinks>(module, "LiveLinks", "Keeps a scene lit while it changes.")
        .def(py::init(&make), "Traces all links; settings as in lumel.h.", py::arg("scene"))
        .def("move", &move, "(4, 4), mesh to world, a rigid motion; update() applies it.",
             py::arg("instance"), py::arg("transform"))
        .def("move_lamp", &move_lamp, "Moves or turns all lamps of this name.", py::arg("name"),
             py::kw_only(), py::arg("position") = py::none(), py::arg("direction") = py::none())
        .def("set_lamp", &set_lamp, "Scales lights, and emission of materials, of this name.",
             py::arg("name"), py::arg("factor"))
        .def("set_sky", &set_sky, "Scales the sky, relative to the scene.", py::arg("factor"))
        .def("set_color", &set_color, "Sets the base colour of a material.", py::arg("material"),
             py::arg("color"))
        .def("update", &update_in_slices<LiveLinks, LiveLinksState>,
             "Runs for about this time, by default until converged.",
             py::arg("budget_ms") = std::numeric_limits<double>::infinity())
        .def("bake", &bake, "Solves to this estimated relative error; returns that reached.",
             py::arg("error") = 0.02)
        .def_property_readonly(
            "state",
            [](const LiveLinks& live) {
                return result_of<LiveLinksState>([&] { return live.state(); });
            },
            "After the last update().")
        .def(
            "map",
            [](const LiveLinks& live) {
                return array_with(result_of<lumel::Map>([&] { return live.map(); }));
            },
            "(height, width, 4), as Baked.map; a new array.")
        .def(
            "lumels",
            [](const LiveLinks& live) {
                return array_with(result_of<lumel::Map>([&] { return live.lumels(); }));
            },
            "(height, width, 4) without gutters and seams, in little time; a new array.")
        .def_property_readonly("surfaces", &LiveLinks::surfaces)
        .def_property_readonly(
            "notes", [](const LiveLinks& live) { return in_python(live.notes()); },
            "Messages for the user.");
}

}  // namespace lumel_python
