// Maps of daylight of a bake, and the hours that are sums of them.

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "module.h"

namespace lumel_python {
namespace {

using lumel::DaylightHour;
using lumel::DaylightMaps;

py::dict maps_of(const py::object& self)
{
    py::dict maps;
    for (const lumel::DaylightMap& one : self.cast<const DaylightMaps&>().maps)
        maps[py::str(one.hour)] = view_of(one.map, self);
    return maps;
}

py::dict hours_of(const py::object& self)
{
    py::dict hours;
    for (const DaylightHour& hour : self.cast<const DaylightMaps&>().hours)
        hours[py::str(hour.hour)] =
            py::cast(&hour, py::return_value_policy::reference_internal, self);
    return hours;
}

py::array_t<float> sun_of(const py::object& self)
{
    const lumel::Vec3& sun = self.cast<const DaylightHour&>().sun;
    return view_of(sun.data(), {py::ssize_t(sun.size())}, self);
}

}  // namespace

void add_daylight_maps(py::module_& module)
{
    py::class_<DaylightHour>(module, "DaylightHour", "An hour of the year with light.")
        .def_readonly("hour", &DaylightHour::hour, "Such as \"06-21T12\", which ends at 13.")
        .def_property_readonly("sun", &sun_of, "(3,) unit direction to the sun.")
        .def_readonly("lux", &DaylightHour::lux, "By direct sun on a plane that faces it.")
        .def_readonly("mean", &DaylightHour::mean, "Of all surfaces, without direct sun [lx].")
        .def_readonly("error", &DaylightHour::error, "Estimated, relative to the hour's light.")
        .def_property_readonly("weights", view_property(&DaylightHour::weights),
                               "(K,) signed, of the maps.");
    py::class_<DaylightMaps>(module, "DaylightMaps",
                             "Maps of daylight, of which each hour of a year is a sum.")
        .def_readonly("place", &DaylightMaps::place, "Name in the weather file.")
        .def_readonly("latitude", &DaylightMaps::latitude, "North, in radians.")
        .def_readonly("longitude", &DaylightMaps::longitude, "East, in radians.")
        .def_readonly("error", &DaylightMaps::error, "Of the sums, RMS over all hours, relative.")
        .def_property_readonly("maps", &maps_of, "K maps by their hours.")
        .def_property_readonly("hours", &hours_of, "Hours with light by their names.");
}

}  // namespace lumel_python
