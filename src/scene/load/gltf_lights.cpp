#include "scene/load/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <glm/gtc/constants.hpp>

#include "scene/load/ies.h"

namespace lumel {

namespace {

constexpr const char* kLampsExtension = "KHR_lights_punctual";
constexpr const char* kProfiles = "EXT_lights_ies";

void read_cone(const JsonView& view, PunctualLight& light)
{
    const JsonView spot = view.get("spot");
    light.inner_cone = spot.number_or("innerConeAngle", light.inner_cone);
    light.outer_cone = spot.number_or("outerConeAngle", light.outer_cone);
    // Exporters round π/2.
    constexpr float kAngleTolerance = 1e-4f;
    if (!(light.inner_cone >= 0.0f && light.inner_cone <= light.outer_cone &&
          light.outer_cone <= glm::half_pi<float>() + kAngleTolerance))
        spot.fail("needs cone angles with 0 <= inner <= outer <= pi/2");
}

PunctualLight read_light(const JsonView& view)
{
    PunctualLight light;
    light.name = view.string_or("name", "");
    const JsonView type = view.get("type");
    if (type.string() == "directional")
        light.kind = PunctualLight::Kind::directional;
    else if (type.string() == "spot")
        light.kind = PunctualLight::Kind::spot;
    else if (type.string() != "point")
        type.fail("is " + quoted(type.string()) + ", but must be directional, point or spot");
    view.numbers("color", &light.color.x, 3);
    light.intensity = view.number_or("intensity", light.intensity);
    if (light.color.x < 0.0f || light.color.y < 0.0f || light.color.z < 0.0f ||
        light.intensity < 0.0f)
        view.fail("has a negative colour or intensity");
    if (const auto range = view.find("range")) {
        light.range = range->number();
        if (light.range <= 0.0f)
            range->fail("must be greater than 0");
    }
    if (light.kind == PunctualLight::Kind::spot)
        read_cone(view, light);
    return light;
}

Camera read_camera(const JsonView& view)
{
    Camera camera;
    camera.name = view.string_or("name", "");
    const JsonView type = view.get("type");
    if (type.string() == "perspective") {
        const JsonView lens = view.get("perspective");
        camera.vertical_fov = lens.get("yfov").number();
        camera.aspect = lens.number_or("aspectRatio", 0.0f);
        if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < glm::pi<float>()))
            lens.get("yfov").fail("must lie between 0 and pi");
        if (camera.aspect < 0.0f)
            lens.get("aspectRatio").fail("must be greater than 0");
    } else if (type.string() == "orthographic") {
        const JsonView lens = view.get("orthographic");
        const float half_width = std::abs(lens.get("xmag").number());
        const float half_height = std::abs(lens.get("ymag").number());
        if (half_width == 0.0f || half_height == 0.0f)
            lens.fail("must have an xmag and a ymag other than 0");
        camera.orthographic_height = 2.0f * half_height;
        camera.aspect = half_width / half_height;
    } else {
        type.fail("is " + quoted(type.string()) + ", but must be perspective or orthographic");
    }
    return camera;
}

/// IES files of EXT_lights_ies, read on first use.
class ProfileList {
public:
    ProfileList(const GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    /// Index into Scene::profiles.
    int find(const JsonView& reference)
    {
        const auto list = document_.root().extension(kProfiles);
        const std::size_t count = list ? list->count("lights") : 0;
        const std::size_t index = reference.index(count, "lights");
        known_.resize(count, -1);
        if (known_[index] < 0) {
            const JsonView view = list->get("lights").at(index);
            known_[index] = int(scene_.profiles.size());
            scene_.profiles.push_back(read_ies(read_linked_bytes(document_, view), view.place(),
                                               view.string_or("name", "")));
        }
        return known_[index];
    }

private:
    const GltfDocument& document_;
    Scene& scene_;
    std::vector<int> known_;  ///< by index in the file; -1: not read yet
};

/// A number in an object's extras; nullopt if absent. Extras may have any type.
std::optional<float> extra(const JsonView& view, const char* key)
{
    const auto extras = view.find("extras");
    if (!extras || !extras->json().is_object())
        return std::nullopt;
    const auto value = extras->find(key);
    if (!value || !value->json().is_number())
        return std::nullopt;
    const float number = value->number();
    if (number < 0.0f)
        value->fail("is a size and cannot be below 0");
    return number;
}

/// Reads the size of a light, which no extension defines: {"radius": m} or {"angle": rad} of node
/// or light.
void read_size(const JsonView& view, PunctualLight& light)
{
    constexpr float kLargestAngle = glm::quarter_pi<float>();
    if (light.kind == PunctualLight::Kind::directional)
        light.angle = std::min(extra(view, "angle").value_or(light.angle), kLargestAngle);
    else
        light.radius = extra(view, "radius").value_or(light.radius);
}

/// EXT_lights_ies: the profile's candela times "multiplier", tinted. Modifies the punctual light
/// on the same node, if any, which keeps its kind, cone, range and colour.
void read_profile(const JsonView& extension, ProfileList& profiles, PunctualLight& light)
{
    glm::vec3 color(1.0f);
    extension.numbers("color", &color.x, 3);
    light.color *= glm::clamp(color, 0.0f, 1.0f);
    light.intensity = extension.number_or("multiplier", 1.0f);
    if (light.intensity < 0.0f)
        extension.fail("has a negative multiplier");
    if (light.kind == PunctualLight::Kind::directional)
        extension.fail("is on the node of a directional light, which has no position");
    light.profile = profiles.find(extension.get("light"));
}

/// The light of a node, if any, without its transform.
std::optional<PunctualLight> read_light_of(const JsonView& root, const JsonView& node,
                                           ProfileList& profiles)
{
    const auto punctual = node.extension(kLampsExtension);
    const auto photometric = node.extension(kProfiles);
    if (!punctual && !photometric)
        return std::nullopt;
    PunctualLight light;
    std::string fallback = "light";
    if (punctual) {
        const auto list = root.extension(kLampsExtension);
        const std::size_t count = list ? list->count("lights") : 0;
        const std::size_t index = punctual->get("light").index(count, "lights");
        const JsonView view = list->get("lights").at(index);
        light = read_light(view);
        read_size(view, light);
        fallback += ' ';
        fallback += std::to_string(index);
    }
    if (photometric)
        read_profile(*photometric, profiles, light);
    read_size(node, light);
    if (light.name.empty())
        light.name = node.string_or("name", fallback);
    return light;
}

/// A node's transform without its scale. Flattened ones get no rotation.
glm::mat4 without_scale(const glm::dmat4& world)
{
    glm::dmat4 rigid(1.0);
    rigid[3] = world[3];
    const glm::dvec3 x(world[0]), y(world[1]), z(world[2]);
    const double side = glm::dot(x, glm::cross(y, z));
    if (side == 0.0)
        return rigid;
    const glm::dvec3 along = glm::normalize(z);
    const glm::dvec3 right = glm::normalize(x - glm::dot(x, along) * along);
    rigid[0] = glm::dvec4(right, 0.0);
    rigid[1] = glm::dvec4(glm::cross(along, right) * (side < 0.0 ? -1.0 : 1.0), 0.0);
    rigid[2] = glm::dvec4(along, 0.0);
    return rigid;
}

}  // namespace

void read_lights_and_cameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                             Scene& scene)
{
    const JsonView root = document.root();
    ProfileList profiles(document, scene);
    for (const PlacedNode& placed : nodes) {
        const JsonView node = root.get("nodes").at(placed.node);
        if (auto light = read_light_of(root, node, profiles)) {
            light->transform = without_scale(placed.world);
            scene.lights.push_back(*light);
        }
        if (const auto reference = node.find("camera")) {
            const std::size_t index = reference->index(root.count("cameras"), "cameras");
            Camera camera = read_camera(root.get("cameras").at(index));
            camera.node = int(placed.node);
            camera.transform = placed.world;
            if (camera.name.empty())
                camera.name = node.string_or("name", "camera " + std::to_string(index));
            scene.cameras.push_back(camera);
        }
    }
}

}  // namespace lumel
