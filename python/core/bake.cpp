// Bakes, probes and lit files.

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "settings.h"

namespace lumel_python {
namespace {

/// The library checks this only without a progress function, and gets one always, for signals.
void check_that_it_ends(const lumel::BakeSettings& bake)
{
    if (bake.error == 0.0 && bake.dark_error == 0.0 && bake.eye_error == 0.0 &&
        bake.visible_noise == 0.0 && bake.seconds == 0.0 && bake.shots == 0)
        throw lumel::Error(lumel::ErrorKind::input,
                           "error: nothing would end the bake: set an error, seconds or shots");
}

lumel::Baked bake(const lumel::Scene& scene, const lumel::Device* device,
                  const py::object& progress, const py::kwargs& given)
{
    const lumel::BakeSettings settings = bake_settings(given);
    if (progress.is_none())
        check_that_it_ends(settings);
    ProgressCalls calls(progress);
    const lumel::ProgressFunction tell = calls.function();
    return result_of<lumel::Baked>([&] {
        try {
            lumel::Baked baked = device ? lumel::bake(*device, scene, settings, tell)
                                        : lumel::bake(scene, settings, tell);
            calls.rethrow();
            return baked;
        } catch (...) {
            calls.rethrow();
            throw;
        }
    });
}

/// Coefficients [n][9][3], noise [n], inside [n].
py::tuple probes(const lumel::Baked& baked, const py::object& places, const py::object& samples)
{
    const std::vector<lumel::Vec3> at = rows<3>({places, "places"});
    const auto rays = value_of<std::uint32_t>({samples, "samples"});
    const auto found =
        result_of<std::vector<lumel::Probe>>([&] { return lumel::probes(baked, at, rays); });
    const auto count = py::ssize_t(found.size());
    py::array_t<float> coefficients({count, py::ssize_t(9), py::ssize_t(3)});
    py::array_t<double> noise(count);
    py::array_t<bool> inside(count);
    for (py::ssize_t i = 0; i < count; ++i) {
        const lumel::Probe& probe = found[std::size_t(i)];
        std::memcpy(coefficients.mutable_data(i), &probe.coefficients, sizeof(probe.coefficients));
        noise.mutable_at(i) = probe.noise;
        inside.mutable_at(i) = probe.inside;
    }
    return py::make_tuple(coefficients, noise, inside);
}

void write_scene(const py::object& path, const lumel::Baked& baked, const py::object& lightmap)
{
    using lumel::LightmapFormat;
    const std::string file = path_of(path);
    const auto format =
        word_of<LightmapFormat>({lightmap, "lightmap"}, {{"ktx2", LightmapFormat::ktx2},
                                                         {"rgb9e5", LightmapFormat::rgb9e5},
                                                         {"png", LightmapFormat::png},
                                                         {"none", LightmapFormat::none}});
    call([&] { lumel::write_scene(file, baked, format); });
}

void write_baked_scene(const py::object& path, const lumel::Baked& baked, const py::object& size)
{
    const std::string file = path_of(path);
    const int side = value_of<int>({size, "size"});
    call([&] { lumel::write_baked_scene(file, baked, side); });
}

void add_surface(py::module_& module)
{
    using lumel::Surface;
    py::class_<Surface>(module, "Surface", "One primitive of one instance in the lightmap.")
        .def_readonly("instance", &Surface::instance)
        .def_readonly("primitive", &Surface::primitive)
        .def_readonly("back", &Surface::back, "True for the back of the preceding surface.")
        .def_readonly("texels_per_metre", &Surface::texels_per_metre)
        .def_property_readonly("source_vertex", view_property(&Surface::source_vertex),
                               "(V,) the source primitive's vertex.")
        .def_property_readonly("lightmap", view_property(&Surface::lightmap),
                               "(V, 2) coordinates in 0 to 1, (0, 0) at the top left.")
        .def_property_readonly("indices", view_property(&Surface::indices),
                               "(3 T,) without triangles of zero area.")
        .def_property_readonly("page", view_property(&Surface::page),
                               "(V,) index into the pages; empty if there is one page.");
}

void add_device_info(py::module_& module)
{
    using lumel::DeviceInfo;
    py::class_<DeviceInfo>(module, "DeviceInfo", "A Vulkan device of this machine.")
        .def_readonly("name", &DeviceInfo::name)
        .def_readonly("type", &DeviceInfo::type)
        .def_readonly("api_version", &DeviceInfo::api_version)
        .def_readonly("driver", &DeviceInfo::driver)
        .def_readonly("memory_bytes", &DeviceInfo::memory_bytes)
        .def_readonly("usable", &DeviceInfo::usable)
        .def_readonly("reason", &DeviceInfo::reason, "Why it is not usable, else empty.")
        .def("__repr__", [](const DeviceInfo& info) {
            return "<lumel.DeviceInfo " + info.name + ", " +
                   (info.usable ? "usable" : info.reason) + ">";
        });
}

py::dict lamps_of(const py::object& self)
{
    py::dict maps;
    for (const lumel::LampMap& lamp : self.cast<const lumel::Baked&>().lamps)
        maps[py::str(lamp.name)] = view_of(lamp.map, self);
    return maps;
}

py::object daylight_of(const py::object& self)
{
    const auto& daylight = self.cast<const lumel::Baked&>().daylight;
    return daylight ? py::cast(&*daylight, py::return_value_policy::reference_internal, self)
                    : py::none();
}

py::list directional_of(const py::object& self)
{
    py::list maps;
    for (const lumel::Map& map : self.cast<const lumel::Baked&>().directional)
        maps.append(view_of(map, self));
    return maps;
}

std::vector<std::tuple<int, int, int>> pages_of(const lumel::Baked& baked)
{
    std::vector<std::tuple<int, int, int>> all;
    for (const lumel::Page& page : baked.pages)
        all.emplace_back(page.x, page.y, page.side);
    return all;
}

void add_baked(py::module_& module)
{
    using lumel::Baked;
    py::class_<Baked>(module, "Baked", "A finished bake. Arrays are views of its memory.")
        .def_property_readonly("map", view_property(&Baked::map),
                               "(height, width, 4) irradiance [lx], and above 0 where a surface "
                               "is.")
        .def_property_readonly("directional", &directional_of,
                               "4 or 9 maps of coefficients of the incoming radiance [cd/m²].")
        .def_property_readonly("lamps", &lamps_of,
                               "Maps of single lamps and groups by name, which add up to the map.")
        .def_property_readonly("daylight", &daylight_of, "With weather_file; else None.")
        .def_readonly("surfaces", &Baked::surfaces)
        .def_property_readonly("pages", &pages_of, "Left, top and side [texels] of each.")
        .def_readonly("texels_per_metre", &Baked::texels_per_metre)
        .def_readonly("error", &Baked::error, "Estimated, relative; below 0: unknown.")
        .def_readonly("eye_error", &Baked::eye_error, "Relative to the light around.")
        .def_readonly("visible_noise", &Baked::visible_noise, "Of plain walls, relative.")
        .def_readonly("shots", &Baked::shots)
        .def_readonly("seconds", &Baked::seconds)
        .def_readonly("interrupted", &Baked::interrupted, "Ended by progress.")
        .def_readonly("relightable", &Baked::relightable, "True if Relight can use it.")
        .def_property_readonly(
            "notes", [](const Baked& baked) { return in_python(baked.notes); },
            "Messages for the user.");
}

}  // namespace

void add_bake(py::module_& module)
{
    add_surface(module);
    add_baked(module);
    add_device_info(module);
    py::class_<lumel::Device>(module, "Device", "A Vulkan device.")
        .def(py::init([](const std::string& pick) {
                 return result_of<lumel::Device>([&] { return lumel::Device(pick); });
             }),
             "pick: index or part of a name; empty: the best.", py::arg("pick") = "")
        .def_property_readonly("name",
                               [](const lumel::Device& device) { return device.info().name; })
        .def_property_readonly("info", &lumel::Device::info, py::return_value_policy::copy);
    module.def(
        "list_devices",
        [] {
            return result_of<std::vector<lumel::DeviceInfo>>([] { return lumel::list_devices(); });
        },
        "All Vulkan devices of this machine.");
    module.def("bake", &bake, "Returns the lightmap of a scene; settings as in lumel.h.",
               py::arg("scene"), py::kw_only(), py::arg("device") = py::none(),
               py::arg("progress") = py::none());
    module.def("probes", &probes, "Incoming light at points: coefficients, noise, inside.",
               py::arg("baked"), py::arg("places"), py::kw_only(), py::arg("samples") = 4096);
    module.def("write_scene", &write_scene, "Writes the scene with its lightmap to a .glb file.",
               py::arg("path"), py::arg("baked"), py::kw_only(), py::arg("lightmap") = "ktx2");
    module.def("write_baked_scene", &write_baked_scene,
               "Writes a .glb file that any viewer shows lit.", py::arg("path"), py::arg("baked"),
               py::kw_only(), py::arg("size") = 2048);
}

}  // namespace lumel_python
