// Scenes, from files and from the classes of lumel/content.py.

#include <optional>
#include <tuple>

#include <lumel/lumel.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "calls.h"
#include "module.h"

namespace lumel_python {
namespace {

using Angles = std::tuple<double, double>;  ///< azimuth, elevation

lumel::Texture texture_of(const Argument& from)
{
    if (!array_of<py::array>(from).dtype().equal(py::dtype::of<std::uint8_t>()))
        throw py::type_error(from.place + " must be an array of the dtype uint8");
    const auto image = image_of<std::uint8_t>(from, 4);
    return {int(image.shape(1)), int(image.shape(0)), {image.data(), image.data() + image.size()}};
}

lumel::Material material_of(const Argument& from)
{
    lumel::Material to;
    read(from["name"], to.name);
    read(from["base_color"], to.base_color);
    read(from["base_color_texture"], to.base_color_texture);
    read(from["emitted"], to.emitted);
    read(from["emitted_texture"], to.emitted_texture);
    read(from["metallic"], to.metallic);
    read(from["roughness"], to.roughness);
    read(from["metallic_roughness_texture"], to.metallic_roughness_texture);
    to.alpha = word_of<lumel::Alpha>(from["alpha"], {{"opaque", lumel::Alpha::opaque},
                                                     {"mask", lumel::Alpha::mask},
                                                     {"blend", lumel::Alpha::blend}});
    read(from["alpha_cutoff"], to.alpha_cutoff);
    read(from["transmission"], to.transmission);
    read(from["double_sided"], to.double_sided);
    return to;
}

/// Negative numbers, and those with fractions, are refused: they would become others.
std::vector<std::uint32_t> indices_of(const Argument& from)
{
    const auto given = array_of<py::array>(from);
    if (given.size() > 0 && given.dtype().kind() != 'i' && given.dtype().kind() != 'u')
        throw py::type_error(from.place + " must be an array of integers");
    const auto wide = contiguous<std::int64_t>({given, from.place});
    std::vector<std::uint32_t> result(wide.data(), wide.data() + wide.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        if (wide.data()[i] != result[i])
            refuse_range<std::uint32_t>(from);
    return result;
}

lumel::Primitive primitive_of(const Argument& from)
{
    lumel::Primitive to;
    to.positions = rows<3>(from["positions"]);
    to.normals = rows<3>(from["normals"]);
    to.texcoords = rows<2>(from["texcoords"]);
    to.lightmap = rows<2>(from["lightmap"]);
    to.colors = rows<4>(from["colors"]);
    to.indices = indices_of(from["indices"]);
    read(from["material"], to.material);
    return to;
}

lumel::Mesh mesh_of(const Argument& from)
{
    return {value_of<std::string>(from["name"]), all_of(from["primitives"], &primitive_of)};
}

lumel::Instance instance_of(const Argument& from)
{
    return {value_of<std::string>(from["name"]), value_of<std::uint32_t>(from["mesh"]),
            matrix_of(from["transform"]), lumel::kNone};
}

lumel::Light light_of(const Argument& from)
{
    using Kind = lumel::Light::Kind;
    lumel::Light to;
    to.kind = word_of<Kind>(
        from["kind"],
        {{"point", Kind::point}, {"spot", Kind::spot}, {"directional", Kind::directional}});
    read(from["name"], to.name);
    read(from["color"], to.color);
    read(from["intensity"], to.intensity);
    read(from["position"], to.position);
    read(from["direction"], to.direction);
    read(from["range"], to.range);
    read(from["inner_cone"], to.inner_cone);
    read(from["outer_cone"], to.outer_cone);
    read(from["radius"], to.radius);
    read(from["angle"], to.angle);
    return to;
}

lumel::Sky sky_of(const Argument& from)
{
    if (from.value.is_none())
        return {};
    const auto image = image_of<float>(from, 3);
    lumel::Sky sky{int(image.shape(1)), int(image.shape(0)), {}};
    sky.luminance.resize(std::size_t(sky.width) * std::size_t(sky.height));
    std::memcpy(sky.luminance.data(), image.data(), sky.luminance.size() * sizeof(lumel::Vec3));
    return sky;
}

lumel::Scene scene_of(const py::object& meshes, const py::object& instances,
                      const py::object& materials, const py::object& lights,
                      const py::object& textures, const py::object& sky)
{
    lumel::SceneContent content;
    content.textures = all_of({textures, "textures"}, &texture_of);
    content.materials = all_of({materials, "materials"}, &material_of);
    content.meshes = all_of({meshes, "meshes"}, &mesh_of);
    content.instances = all_of({instances, "instances"}, &instance_of);
    content.lights = all_of({lights, "lights"}, &light_of);
    content.sky = sky_of({sky, "sky"});
    return result_of<lumel::Scene>([&] { return lumel::Scene(content); });
}

lumel::Scene load(const py::object& path, const py::object& materials)
{
    const std::string file = path_of(path);
    const auto read =
        word_of<lumel::Materials>({materials, "materials"}, {{"diffuse", lumel::Materials::diffuse},
                                                             {"glossy", lumel::Materials::glossy}});
    return result_of<lumel::Scene>([&] { return lumel::Scene::load(file, read); });
}

std::optional<lumel::Daylight::Sun> sun_of(const std::optional<Angles>& angles)
{
    if (!angles)
        return std::nullopt;
    return lumel::Daylight::Sun{std::get<0>(*angles), std::get<1>(*angles)};
}

void add_daylight(lumel::Scene& scene, const std::optional<Angles>& sun,
                  const std::optional<lumel::Vec3>& sky_luminance, const py::object& sky_file,
                  const std::optional<int>& cie, const std::optional<float>& cie_lux,
                  const std::optional<Angles>& cie_sun, float sky_scale, float ground,
                  double rotation)
{
    if (!cie && (cie_lux || cie_sun))
        throw py::value_error("cie_lux and cie_sun need cie, the type of the sky");
    lumel::Daylight light;
    if (!sky_file.is_none())
        light.sky_file = path_of(sky_file);
    light.sky_luminance = sky_luminance;
    if (cie)
        light.cie = lumel::Daylight::Cie{*cie, cie_lux.value_or(lumel::Daylight::Cie().lux),
                                         sun_of(cie_sun)};
    light.sun = sun_of(sun);
    light.sky_scale = sky_scale;
    light.ground = ground;
    light.rotation = rotation;
    call([&] { scene.add_daylight(light); });
}

std::vector<lumel::Instance> instances_of(const lumel::Scene& scene)
{
    return result_of<std::vector<lumel::Instance>>([&] { return scene.instances(); });
}

std::vector<std::string> names_of_instances(const lumel::Scene& scene)
{
    std::vector<std::string> names;
    for (const lumel::Instance& one : instances_of(scene))
        names.push_back(one.name);
    return names;
}

/// [n][4][4], for columns.
py::array_t<float> transforms(const lumel::Scene& scene)
{
    const std::vector<lumel::Instance> instances = instances_of(scene);
    py::array_t<float> result({py::ssize_t(instances.size()), py::ssize_t(4), py::ssize_t(4)});
    for (std::size_t i = 0; i < instances.size(); ++i)
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                result.mutable_at(i, row, column) =
                    instances[i].transform[std::size_t(4 * column + row)];
    return result;
}

}  // namespace

void add_scene(py::module_& module)
{
    using lumel::Scene;
    using Strings = std::vector<std::string>;
    py::class_<Scene>(module, "Scene", "A checked scene. Its arrays are copied.")
        .def(py::init(&scene_of), "Makes a scene of arrays.", py::kw_only(), py::arg("meshes"),
             py::arg("instances"), py::arg("materials"), py::arg("lights") = py::tuple(),
             py::arg("textures") = py::tuple(), py::arg("sky") = py::none())
        .def_static("load", &load, "Reads a glTF 2.0 file.", py::arg("path"), py::kw_only(),
                    py::arg("materials") = "diffuse")
        .def("add_daylight", &add_daylight, "Replaces the sky, and adds the sun as a light.",
             py::kw_only(), py::arg("sun") = py::none(), py::arg("sky_luminance") = py::none(),
             py::arg("sky_file") = py::none(), py::arg("cie") = py::none(),
             py::arg("cie_lux") = py::none(), py::arg("cie_sun") = py::none(),
             py::arg("sky_scale") = 1.0f, py::arg("ground") = 0.0f, py::arg("rotation") = 0.0)
        .def_property_readonly("instances", &names_of_instances, "Names of visible instances.")
        .def_property_readonly("transforms", &transforms, "(n, 4, 4) of the instances.")
        .def_property_readonly(
            "lights",
            [](const Scene& scene) { return result_of<Strings>([&] { return scene.lights(); }); },
            "Names.")
        .def_property_readonly(
            "warnings",
            [](const Scene& scene) {
                return in_python(result_of<Strings>([&] { return scene.warnings(); }));
            },
            "Features ignored, or data repaired, while loading.")
        .def(
            "find_instance",
            [](const Scene& scene, const std::string& name) {
                return result_of<std::uint32_t>([&] { return scene.find_instance(name); });
            },
            "Index of the first instance with this name.", py::arg("name"));
}

}  // namespace lumel_python
