// Scenes of lumel_c.h.

#include "api/c_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "api/c_calls.h"

namespace lumel::v0 {
namespace {

[[noreturn]] void refuse_content(const std::string& place, const std::string& what)
{
    throw Error(ErrorKind::input, place + ": " + what);
}

std::string entry_of(const char* list, std::size_t number)
{
    return std::string(list) + "[" + std::to_string(number) + "]";
}

/// Called before that many texels are copied.
void check_sides(int width, int height, const std::string& place)
{
    constexpr int kLargestSide = 1 << 16;
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
        refuse_content(place, "its sides must lie between 1 and " + std::to_string(kLargestSide));
}

/// Number of a pointer in the order of first uses; a new one if `is_new`.
struct Numbered {
    int number;
    bool is_new;
};

class ContentReader {
public:
    CContent read(const lumel_content& from)
    {
        if (from.instance_count > 0)
            require(from.instances, "content.instances");
        for (std::uint32_t i = 0; i < from.instance_count; ++i)
            add_instance(from.instances[i], entry_of("instances", i));
        if (from.light_count > 0)
            require(from.lights, "content.lights");
        for (std::uint32_t l = 0; l < from.light_count; ++l)
            result_.content.lights.push_back(light_of(from.lights[l], entry_of("lights", l)));
        if (from.sky)
            read_sky(*from.sky);
        return std::move(result_);
    }

private:
    template <class T>
    static Numbered number_of(std::map<const T*, int>& numbers, const T* pointer)
    {
        const auto [place, is_new] = numbers.try_emplace(pointer, int(numbers.size()));
        return {place->second, is_new};
    }

    template <std::size_t N>
    static std::vector<std::array<float, N>> vertices_of(const float* values,
                                                         const std::vector<std::uint32_t>& used)
    {
        std::vector<std::array<float, N>> result;
        if (!values)
            return result;
        result.resize(used.size());
        for (std::size_t i = 0; i < used.size(); ++i)
            std::memcpy(result[i].data(), values + std::size_t(used[i]) * N, sizeof(result[i]));
        return result;
    }

    int texture(const lumel_texture* from)
    {
        if (!from)
            return kNone;
        const Numbered known = number_of(textures_, from);
        if (!known.is_new)
            return known.number;
        const std::string place = entry_of("textures", std::size_t(known.number));
        require(from->rgba, place + ".rgba");
        check_sides(from->width, from->height, place);
        const std::size_t bytes = 4 * std::size_t(from->width) * std::size_t(from->height);
        result_.content.textures.push_back(
            {from->width, from->height, {from->rgba, from->rgba + bytes}});
        return known.number;
    }

    Alpha alpha_of(int alpha, const std::string& place) const
    {
        switch (alpha) {
        case LUMEL_OPAQUE:
            return Alpha::opaque;
        case LUMEL_MASK:
            return Alpha::mask;
        case LUMEL_BLEND:
            return Alpha::blend;
        }
        refuse_content(place, "its alpha is unknown");
    }

    std::uint32_t material(const lumel_material* from)
    {
        const Numbered known = number_of(materials_, from);
        if (!known.is_new)
            return std::uint32_t(known.number);
        const std::string place = entry_of("materials", std::size_t(known.number));
        Material material;
        material.name = text_of(from->name);
        std::copy_n(from->base_color, 4, material.base_color.begin());
        material.base_color_texture = texture(from->base_color_texture);
        std::copy_n(from->emitted, 3, material.emitted.begin());
        material.emitted_texture = texture(from->emitted_texture);
        material.alpha = alpha_of(from->alpha, place);
        if (from->alpha_cutoff != 0.0f)
            material.alpha_cutoff = from->alpha_cutoff;
        material.transmission = from->transmission;
        material.double_sided = from->double_sided != 0;
        result_.content.materials.push_back(std::move(material));
        return std::uint32_t(known.number);
    }

    /// [material] indices of a mesh's triangles.
    static std::vector<std::vector<std::uint32_t>> triangles_by_material(const lumel_mesh& mesh,
                                                                         const std::string& place)
    {
        std::vector<std::vector<std::uint32_t>> triangles(
            mesh.triangle_count > 0 ? mesh.material_count : 0);
        for (std::uint32_t t = 0; t < mesh.triangle_count; ++t) {
            const std::uint32_t material = mesh.triangle_materials ? mesh.triangle_materials[t] : 0;
            if (material >= mesh.material_count)
                refuse_content(place + "." + entry_of("triangle_materials", t),
                               "is " + std::to_string(material) + ", but there are " +
                                   std::to_string(mesh.material_count) + " materials");
            for (std::size_t corner = 3 * std::size_t(t); corner < 3 * std::size_t(t) + 3;
                 ++corner) {
                if (mesh.indices[corner] >= mesh.vertex_count)
                    refuse_content(place + "." + entry_of("indices", corner),
                                   "is " + std::to_string(mesh.indices[corner]) +
                                       ", but there are " + std::to_string(mesh.vertex_count) +
                                       " vertices");
                triangles[material].push_back(mesh.indices[corner]);
            }
        }
        return triangles;
    }

    /// A primitive with the vertices that its triangles use, in ascending order.
    static Primitive primitive_of(const lumel_mesh& from, std::vector<std::uint32_t> indices,
                                  std::vector<std::uint32_t>& used)
    {
        used = indices;
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& index : indices)
            index = std::uint32_t(std::ranges::lower_bound(used, index) - used.begin());
        Primitive primitive;
        primitive.positions = vertices_of<3>(from.positions, used);
        primitive.normals = vertices_of<3>(from.normals, used);
        primitive.texcoords = vertices_of<2>(from.texcoords, used);
        primitive.lightmap = vertices_of<2>(from.lightmap, used);
        primitive.colors = vertices_of<4>(from.colors, used);
        primitive.indices = std::move(indices);
        return primitive;
    }

    template <std::size_t N>
    static void check_vertices(const float* values, std::uint32_t count, const std::string& name)
    {
        for (std::size_t i = 0; values && i < std::size_t(count) * N; ++i)
            if (!std::isfinite(values[i]))
                refuse_content(name + "[" + std::to_string(i / N) + "]", "is not finite");
    }

    /// Scene checks primitives, whose vertices have other numbers than those of the mesh.
    static void check_arrays(const lumel_mesh& mesh, const std::string& place)
    {
        require(mesh.positions, place + ".positions");
        require(mesh.indices, place + ".indices");
        if (mesh.material_count == 0)
            refuse_content(place, "has no materials");
        require(mesh.materials, place + ".materials");
        check_vertices<3>(mesh.positions, mesh.vertex_count, place + ".positions");
        check_vertices<2>(mesh.texcoords, mesh.vertex_count, place + ".texcoords");
        check_vertices<2>(mesh.lightmap, mesh.vertex_count, place + ".lightmap");
        check_vertices<4>(mesh.colors, mesh.vertex_count, place + ".colors");
    }

    std::uint32_t mesh(const lumel_mesh* from)
    {
        const Numbered known = number_of(meshes_, from);
        if (!known.is_new)
            return std::uint32_t(known.number);
        const std::string place = entry_of("meshes", std::size_t(known.number));
        if (from->triangle_count > 0)
            check_arrays(*from, place);
        Mesh mesh{.name = text_of(from->name), .primitives = {}};
        std::vector<std::vector<std::uint32_t>> used;
        for (std::vector<std::uint32_t>& indices : triangles_by_material(*from, place)) {
            const auto m = std::uint32_t(mesh.primitives.size());
            mesh.primitives.push_back(primitive_of(*from, std::move(indices), used.emplace_back()));
            mesh.primitives.back().material = material(from->materials + m);
        }
        result_.content.meshes.push_back(std::move(mesh));
        result_.vertices.push_back(std::move(used));
        return std::uint32_t(known.number);
    }

    void add_instance(const lumel_instance& from, const std::string& place)
    {
        require(from.mesh, place + ".mesh");
        Instance instance{.name = text_of(from.name), .mesh = mesh(from.mesh)};
        if (std::ranges::any_of(from.transform, [](float x) { return x != 0.0f; }))
            std::copy_n(from.transform, instance.transform.size(), instance.transform.begin());
        result_.content.instances.push_back(std::move(instance));
    }

    static Light::Kind kind_of(int kind, const std::string& place)
    {
        switch (kind) {
        case LUMEL_POINT:
            return Light::Kind::point;
        case LUMEL_SPOT:
            return Light::Kind::spot;
        case LUMEL_DIRECTIONAL:
            return Light::Kind::directional;
        }
        refuse_content(place, "its kind is unknown");
    }

    static Light light_of(const lumel_light& from, const std::string& place)
    {
        const auto given = [](const float(&values)[3]) {
            return std::ranges::any_of(values, [](float x) { return x != 0.0f; });
        };
        Light light;
        light.kind = kind_of(from.kind, place);
        light.name = text_of(from.name);
        if (given(from.color))
            std::copy_n(from.color, 3, light.color.begin());
        light.intensity = from.intensity;
        std::copy_n(from.position, 3, light.position.begin());
        if (given(from.direction))
            std::copy_n(from.direction, 3, light.direction.begin());
        light.range = from.range;
        light.inner_cone = from.inner_cone;
        if (from.outer_cone != 0.0f)
            light.outer_cone = from.outer_cone;
        light.radius = from.radius;
        light.angle = from.angle;
        return light;
    }

    void read_sky(const lumel_sky& from)
    {
        require(from.luminance, "sky.luminance");
        check_sides(from.width, from.height, "sky");
        Sky& sky = result_.content.sky;
        sky.width = from.width;
        sky.height = from.height;
        sky.luminance.resize(std::size_t(from.width) * std::size_t(from.height));
        std::memcpy(sky.luminance.data(), from.luminance, sky.luminance.size() * sizeof(Vec3));
    }

    CContent result_;
    std::map<const lumel_mesh*, int> meshes_;
    std::map<const lumel_material*, int> materials_;
    std::map<const lumel_texture*, int> textures_;
};

Daylight daylight_of(const lumel_daylight& from)
{
    Daylight daylight;
    daylight.sky_file = text_of(from.sky_file);
    if (from.sky_luminance)
        daylight.sky_luminance =
            Vec3{from.sky_luminance[0], from.sky_luminance[1], from.sky_luminance[2]};
    const Daylight::Sun sun{from.sun_azimuth, from.sun_elevation};
    if (from.cie_sky != 0) {
        daylight.cie = Daylight::Cie{.type = from.cie_sky};
        if (from.cie_lux != 0.0f)
            daylight.cie->lux = from.cie_lux;
        if (from.has_sun == LUMEL_SUN_OF_SKY)
            daylight.cie->sun = sun;
    }
    if (from.has_sun == LUMEL_SUN)
        daylight.sun = sun;
    if (from.sky_scale != 0.0f)
        daylight.sky_scale = from.sky_scale;
    daylight.ground = from.ground;
    daylight.rotation = from.rotation;
    return daylight;
}

}  // namespace

CContent content_of(const lumel_content& from)
{
    return ContentReader().read(from);
}

}  // namespace lumel::v0

using namespace lumel::v0;

lumel_result lumel_make_scene(const lumel_content* content, lumel_scene** scene)
{
    return guarded([&] {
        require(content, "content");
        require(scene, "scene");
        CContent read = content_of(*content);
        *scene = new lumel_scene{Scene(read.content), std::move(read.vertices)};
    });
}

lumel_result lumel_load_scene(const char* path, lumel_scene** scene)
{
    return guarded([&] {
        require(path, "path");
        require(scene, "scene");
        *scene = new lumel_scene{Scene::load(path), {}};
    });
}

void lumel_free_scene(lumel_scene* scene)
{
    delete scene;
}

lumel_result lumel_add_daylight(lumel_scene* scene, const lumel_daylight* from)
{
    return guarded([&] {
        require(scene, "scene");
        require(from, "daylight");
        scene->scene.add_daylight(daylight_of(*from));
    });
}
