// The light has the luminance L = colour × intensity [cd/m²] over its area A, and sends the flux
// π L A. An extra "aspect" of disks, width / height, makes ellipses.

#include "scene/gltf/area_lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <utility>

#include <glm/glm.hpp>

#include "scene/gltf/extensions.h"
#include "scene/gltf/extras.h"

namespace lumel {

namespace {

constexpr const char* kAreaLights = "EXT_lights_area";
constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
constexpr double kMinSide = 1e-6, kMaxSide = 1e9;  // [m]
/// Distance of the shape from the node's origin along its -z, relative to its longer side: lights
/// that lie in a ceiling are not hidden by it.
constexpr double kLift = 1e-4;
/// Sides of the polygon that replaces a disk.
constexpr int kDiskSides = 32;
/// Texels along the longer side: solvers that shoot from lumels need some, the map needs none.
constexpr double kTexels = 8.0;

enum class Shape { rect, disk };
constexpr Named<Shape> kShapes[] = {{"rect", Shape::rect}, {"disk", Shape::disk}};

struct AreaLight {
    std::string name;
    Shape shape = Shape::rect;
    double width = 1.0;  ///< along x [m]
    double height = 1.0;
    glm::vec3 luminance{0.0f};  ///< [cd/m²]
};

/// A node of the document and the light on it.
struct LitNode {
    std::size_t node = 0;
    std::size_t light = 0;
    Json child;  ///< the node to append, without its mesh
};

double aspect_of(const JsonView& view, Shape shape)
{
    const auto holder = view.find(shape == Shape::rect ? "rect" : kExtras);
    if (!holder || !holder->json().is_object())
        return 1.0;
    const auto aspect = holder->find("aspect");
    return aspect ? aspect->number(kMinSide, kMaxSide) : 1.0;
}

AreaLight read_area_light(const JsonView& view)
{
    AreaLight light;
    light.name = view.string_or("name", "");
    light.shape = named_by(view.get("type"), kShapes);
    if (const auto size = view.find("size"))
        light.height = size->number(kMinSide, kMaxSide);
    light.width = light.height * aspect_of(view, light.shape);
    if (!(light.width >= kMinSide && light.width <= kMaxSide))
        view.fail("is wider than 1e9 m or narrower than 1e-6 m");
    glm::vec3 color(1.0f);
    view.numbers("color", &color.x, 3);
    light.luminance = color * view.number_or("intensity", 1000.0f);
    for (int c = 0; c < 3; ++c)
        if (!(light.luminance[c] >= 0.0f && std::isfinite(light.luminance[c])))
            view.fail("emits a negative or infinite amount of light");
    return light;
}

/// Corners in the plane z = 0, clockwise as seen from +z: the front faces -z.
std::vector<glm::dvec2> outline_of(const AreaLight& light)
{
    const glm::dvec2 half(0.5 * light.width, 0.5 * light.height);
    if (light.shape == Shape::rect)
        return {{-half.x, -half.y}, {-half.x, half.y}, {half.x, half.y}, {half.x, -half.y}};
    // The polygon has the area of the disk.
    constexpr double kStep = 2.0 * std::numbers::pi / kDiskSides;
    const double scale = std::sqrt(kStep / std::sin(kStep));
    std::vector<glm::dvec2> corners;
    for (int i = 0; i < kDiskSides; ++i)
        corners.push_back(scale * half * glm::dvec2(std::cos(kStep * i), -std::sin(kStep * i)));
    return corners;
}

/// Appends data to the document; returns the index of its accessor.
template <typename T>
std::size_t add_accessor(GltfDocument& document, const std::vector<T>& values, Json accessor)
{
    Bytes bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    Json& json = document.json;
    accessor["bufferView"] = json["bufferViews"].size();
    json["bufferViews"].push_back(
        {{"buffer", document.buffers.size()}, {"byteLength", bytes.size()}});
    json["buffers"].push_back({{"byteLength", bytes.size()}});
    document.buffers.push_back(std::move(bytes));
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
}

std::size_t add_light_material(Json& json, const AreaLight& light)
{
    const glm::vec3& l = light.luminance;
    const float strength = std::max({l.r, l.g, l.b});
    json["materials"].push_back(
        {{"name", light.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
         {"emissiveFactor", {l.r / strength, l.g / strength, l.b / strength}},
         {"extensions", {{kEmissiveStrength, {{"emissiveStrength", strength}}}}}});
    return json["materials"].size() - 1;
}

/// Appends the mesh of a light; returns its index.
std::size_t add_mesh(GltfDocument& document, const AreaLight& light)
{
    const double longer = std::max(light.width, light.height);
    std::vector<glm::vec3> positions;
    for (const glm::dvec2& corner : outline_of(light))
        positions.emplace_back(corner.x, corner.y, -kLift * longer);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 2; i < positions.size(); ++i)
        indices.insert(indices.end(), {0, i - 1, i});

    const auto count = positions.size();
    const std::size_t position = add_accessor(
        document, positions,
        {{"componentType", int(ComponentType::f32)}, {"count", count}, {"type", "VEC3"}});
    const std::size_t index = add_accessor(document, indices,
                                           {{"componentType", int(ComponentType::u32)},
                                            {"count", indices.size()},
                                            {"type", "SCALAR"}});
    Json& json = document.json;
    const std::size_t material = add_light_material(json, light);
    const Json primitive = {
        {"attributes", {{"POSITION", position}}}, {"indices", index}, {"material", material}};
    Json mesh = {{"name", light.name}, {"primitives", Json::array({primitive})}};
    extras_of(mesh)["lumel"]["texels_per_metre"] = std::clamp(kTexels / longer, 1e-6, 1e9);
    json["meshes"].push_back(std::move(mesh));
    return json["meshes"].size() - 1;
}

/// Scale that makes the node's own one uniform: lights grow by its largest component.
glm::vec3 evened_scale(const JsonView& node)
{
    glm::vec3 scale(1.0f);
    node.numbers("scale", &scale.x, 3);
    scale = glm::abs(scale);
    const float largest = std::max({scale.x, scale.y, scale.z});
    const glm::vec3 evened = largest / scale;
    return glm::all(glm::lessThan(evened, glm::vec3(1e9f))) ? evened : glm::vec3(1.0f);
}

LitNode read_lit_node(const JsonView& root, const JsonView& node, std::size_t index)
{
    const auto list = root.extension(kAreaLights);
    const std::size_t count = list ? list->count("lights") : 0;
    LitNode lit{.node = index,
                .light = node.extension(kAreaLights)->get("light").index(count, "lights"),
                .child = Json::object()};
    const JsonView light = list->get("lights").at(lit.light);
    std::string name = light.string_or("name", "");
    if (name.empty())
        name = node.string_or("name", "light " + std::to_string(lit.light));
    lit.child["name"] = std::move(name);
    if (const glm::vec3 scale = evened_scale(node); scale != glm::vec3(1.0f))
        lit.child["scale"] = {scale.x, scale.y, scale.z};
    if (const float density = density_in_extras(node); density > 0.0f)
        extras_of(lit.child)["lumel"]["texels_per_metre"] = density;
    node.count("children");  // throws unless it is a list or absent
    return lit;
}

}  // namespace

void expand_area_lights(GltfDocument& document)
{
    // JsonViews refer to locations in the JSON, so it changes only after all nodes are read.
    std::vector<LitNode> nodes;
    std::map<std::size_t, AreaLight> lights;
    const JsonView root = document.root();
    root.each("nodes", [&](const JsonView& node, std::size_t i) {
        if (!node.extension(kAreaLights))
            return;
        nodes.push_back(read_lit_node(root, node, i));
        const std::size_t light = nodes.back().light;
        if (!lights.contains(light)) {
            lights[light] = read_area_light(root.extension(kAreaLights)->get("lights").at(light));
            if (lights[light].name.empty())
                lights[light].name = "light " + std::to_string(light);
        }
    });
    Json& json = document.json;
    std::map<std::size_t, std::size_t> meshes;
    for (const auto& [index, light] : lights)
        if (light.luminance != glm::vec3(0.0f))
            meshes[index] = add_mesh(document, light);
    for (LitNode& lit : nodes) {
        erase_extension(json["nodes"][lit.node], kAreaLights);
        if (!meshes.contains(lit.light))
            continue;
        lit.child["mesh"] = meshes[lit.light];
        json["nodes"][lit.node]["children"].push_back(json["nodes"].size());
        json["nodes"].push_back(std::move(lit.child));
    }
    if (json.is_object())
        erase_extension(json, kAreaLights);
    forget_extension(json, kAreaLights);
    if (!meshes.empty() && !uses_extension(document.root(), kEmissiveStrength))
        json["extensionsUsed"].push_back(kEmissiveStrength);
}

}  // namespace lumel
