#include "scene/gltf_lights.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

namespace lumel {

namespace {

constexpr const char* kLights = "KHR_lights_punctual";

void read_cone(const JsonView& view, PunctualLight& light)
{
    const JsonView spot = view.get("spot");
    light.inner_cone = spot.number_or("innerConeAngle", light.inner_cone);
    light.outer_cone = spot.number_or("outerConeAngle", light.outer_cone);
    // Exporters write π/2 with few digits.
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
        view.fail("shines with a negative colour or intensity");
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

}  // namespace

void read_lights_and_cameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                             Scene& scene)
{
    const JsonView root = document.root();
    const auto light_list = root.extension(kLights);
    for (const PlacedNode& placed : nodes) {
        const JsonView node = root.get("nodes").at(placed.node);
        if (const auto extension = node.extension(kLights)) {
            const JsonView reference = extension->get("light");
            const std::size_t count = light_list ? light_list->count("lights") : 0;
            const std::size_t index = reference.index(count, "lights");
            PunctualLight light = read_light(light_list->get("lights").at(index));
            light.transform = placed.world;
            if (light.name.empty())
                light.name = node.string_or("name", "light " + std::to_string(index));
            scene.lights.push_back(light);
        }
        if (const auto reference = node.find("camera")) {
            const std::size_t index = reference->index(root.count("cameras"), "cameras");
            Camera camera = read_camera(root.get("cameras").at(index));
            camera.transform = placed.world;
            if (camera.name.empty())
                camera.name = node.string_or("name", "camera " + std::to_string(index));
            scene.cameras.push_back(camera);
        }
    }
}

}  // namespace lumel
